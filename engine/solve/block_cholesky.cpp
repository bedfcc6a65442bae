// 3x3-block Cholesky L D L^T by panels. The structure is fixed, so the index of every block update
// is computed once.
#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/core/block3.h"
#include "engine/elastic/model.h"
#include "engine/solve/block_factor.h"
#include "engine/solve/linear_solver.h"

namespace gridshell {
namespace {

/// Where a block of the Hessian goes: from the pair `from` to the block `to` below the diagonal.
struct Move {
  int from, to;
};

/// Blocks begin to end below the diagonal.
struct Range {
  int begin, end;
};

GRIDSHELL_CLONES
void copy_blocks(const std::vector<Block3>& pair, const Move* begin, const Move* end, bool turn,
                 Block3* below) {
  for (const Move* move = begin; move != end; ++move) {
    const Block3& from = pair[std::size_t(move->from)];
    Block3& to = below[std::size_t(move->to)];
    if (turn)
      transpose(from, to);
    else
      to = from;
  }
}

class BlockCholesky final : public LinearSolver {
 public:
  explicit BlockCholesky(const Model& model) : model_(model) {
    const auto graph = hessian_graph(model);
    order_ = nested_dissection(model, graph);
    find_structure(graph);
    std::vector<int> branch = branches_of(factor_);
    if (std::ranges::count(branch, 0) < factor_.columns) {
      // an equivalent order in which each branch is contiguous
      std::vector<int> old(order_.size());
      std::iota(old.begin(), old.end(), 0);
      std::ranges::stable_sort(old, {}, [&](int k) { return branch[std::size_t(k)]; });
      for (int& k : old) k = order_[std::size_t(k)];
      order_ = std::move(old);
      std::ranges::sort(branch);
      find_structure(graph);
    }
    for (int k : order_) column_.push_back(model.free_columns[std::size_t(k)]);
    find_panels(branch);
    plan_sharing(factor_, branch);
    plan_updates();
    plan_first_updates(plan_copies());
  }

  Inertia factor(const BlockHessian& hessian, double shift) override {
    take_numbers();
    fill(hessian, shift);
    return factor_numbers(factor_, most_negative, team);
  }

  void solve(Eigen::Matrix3Xd& b) const override {
    work_.resize(order_.size());
    std::vector<Entry>& x = work_;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      load(b.col(column_[k]), x[k].value);
      for (int c = 0; partly_[k] && c < 3; ++c)
        if (model_.fixed[std::size_t(column_[k])] >> c & 1) x[k].value[c] = 0;
    }
    solve_numbers(factor_, x.data(), team);
    b.setZero();
    for (std::size_t k = 0; k < order_.size(); ++k)
      b.col(column_[k]) << x[k].value[0], x[k].value[1], x[k].value[2];
  }

  bool has_factor() const override { return numbers && numbers->of == this; }

  long long blocks() const override { return (long long)(factor_.row.size() + order_.size()); }

 private:
  void take_numbers() {
    if (!numbers) numbers = std::make_shared<FactorNumbers>();
    numbers->of = nullptr;  // in case an allocation below fails
    const auto take = [](auto& all, std::size_t count) {
      if (all.size() < count) std::exchange(all, {}), all.resize(count);
      return all.data();
    };
    factor_.diagonal = take(numbers->diagonal, order_.size());
    factor_.inverse = take(numbers->inverse, order_.size());
    factor_.below = take(numbers->below, factor_.row.size());
    numbers->of = this;
  }

  /// Computes the rows below the diagonal of each column of L, in elimination order: those of the
  /// Hessian, and those of the column's children in the elimination tree, the columns whose first
  /// row is this one.
  void find_structure(const std::vector<std::vector<int>>& graph) {
    const int n = int(order_.size());
    position_.resize(order_.size());
    for (int k = 0; k < n; ++k) position_[order_[k]] = k;
    factor_ = {};
    factor_.columns = n;
    factor_.first.assign(1, 0);
    std::vector<int>& rows = factor_.row;
    std::vector<int> last_child(std::size_t(n), -1), child_before(std::size_t(n), -1),
        seen(std::size_t(n), -1);
    for (int k = 0; k < n; ++k) {
      const std::size_t begin = rows.size();
      seen[k] = k;
      const auto take = [&](int row) {
        if (row > k && seen[row] != k) seen[row] = k, rows.push_back(row);
      };
      for (int other : graph[order_[k]]) take(position_[other]);
      for (int child = last_child[k]; child >= 0; child = child_before[child])
        for (int i = factor_.first[child]; i < factor_.first[child + 1]; ++i) take(rows[i]);
      std::sort(rows.begin() + long(begin), rows.end());
      factor_.first.push_back(int(rows.size()));
      if (rows.size() > begin) child_before[k] = std::exchange(last_child[rows[begin]], k);
    }
  }

  int slot(int row, int column) const {
    const auto begin = factor_.row.begin() + factor_.first[column],
               end = factor_.row.begin() + factor_.first[column + 1];
    return int(std::lower_bound(begin, end, row) - factor_.row.begin());
  }

  void find_panels(const std::vector<int>& branch) {
    std::vector<int>& panel = factor_.panel;
    for (int k = 0; k < factor_.columns; ++k) {
      const bool same = k > 0 && branch[k] == branch[k - 1] &&
                        factor_.rows_below(k - 1) == factor_.rows_below(k) + 1 &&
                        factor_.row[factor_.first[k - 1]] == k;
      if (!same || k - panel.back() == widest_panel) panel.push_back(k);
    }
    panel.push_back(factor_.columns);
  }

  void plan_updates() {
    std::size_t updates = 0;
    for (std::size_t p = 0; p + 1 < factor_.panel.size(); ++p) {
      const std::size_t rows = std::size_t(factor_.rows_below(factor_.panel[p + 1] - 1));
      updates += rows * (rows + 1) / 2;
    }
    factor_.target.reserve(updates);
    const std::vector<int>& row = factor_.row;
    for (std::size_t p = 0; p + 1 < factor_.panel.size(); ++p) {
      factor_.first_target.push_back((long long)factor_.target.size());
      const int last = factor_.panel[p + 1] - 1, end = factor_.first[last + 1];
      for (int a = factor_.first[last]; a < end; ++a) {
        factor_.target.push_back(row[a]);
        // the rows of column row[a] contain all later rows of this one: walk both at once
        int at = factor_.first[row[a]];
        for (int b = a + 1; b < end; ++b) {
          while (row[at] != row[b]) ++at;
          factor_.target.push_back(at);
        }
      }
    }
  }

  /// Plans the copies of the Hessian's blocks. Returns which blocks below the diagonal it has.
  std::vector<char> plan_copies() {
    std::vector<char> filled(factor_.row.size(), 0);
    const auto& pattern = model_.pattern.pairs();
    for (int k = 0; k < int(pattern.size()); ++k) {
      const auto [row, column] = pattern[std::size_t(k)];
      const int a = model_.free_index[std::size_t(row)], b = model_.free_index[std::size_t(column)];
      if (a < 0 || b < 0) continue;
      // the block is stored with the later node as row
      const bool turn = position_[a] < position_[b];
      const int to = turn ? slot(position_[b], position_[a]) : slot(position_[a], position_[b]);
      filled[std::size_t(to)] = 1;
      const bool partly = model_.fixed[std::size_t(row)] || model_.fixed[std::size_t(column)];
      (turn ? turned_ : straight_).push_back({k, to});
      if (partly) (turn ? partly_turned_ : partly_straight_).push_back({k, to});
    }
    for (int column : column_) partly_.push_back(model_.fixed[std::size_t(column)] != 0);
    return filled;
  }

  /// A block that the Hessian does not have begins as the first update of a narrow panel; where a
  /// wide one comes first, it is set to zero before.
  void plan_first_updates(std::vector<char> filled) {
    std::vector<char> zero(filled.size(), 0);
    const auto take = [&](int block) { zero[block] |= char(!std::exchange(filled[block], 1)); };
    int* target = factor_.target.data();
    for (std::size_t p = 0; p + 1 < factor_.panel.size(); ++p) {
      const int begin = factor_.panel[p], end = factor_.panel[p + 1];
      for (int k = begin + 1; k < end; ++k)
        for (int i = factor_.first[k]; i < factor_.first[k + 1]; ++i) take(i);
      const int rows = factor_.rows_below(end - 1);
      for (int a = 0; a < rows; ++a) {
        ++target;  // on the diagonal
        for (int b = a + 1; b < rows; ++b, ++target) {
          if (end - begin > 1)
            take(*target);
          else if (!std::exchange(filled[*target], 1))
            *target = ~*target;
        }
      }
    }
    for (int block = 0; block < int(zero.size()); ++block) {
      if (!zero[std::size_t(block)]) continue;
      if (empty_.empty() || empty_.back().end != block) empty_.push_back({block, block});
      empty_.back().end = block + 1;
    }
  }

  void fill(const BlockHessian& hessian, double shift) {
    const auto some = [&](std::size_t count, const auto& task) {
      const int pieces = team && factor_.branches() > 0 ? 4 * team->threads() : 1;
      parallel_for(team, pieces,
                   [&](int k) { task(count * k / pieces, count * (k + 1) / pieces); });
    };
    for (const auto* moves : {&straight_, &turned_})
      some(moves->size(), [&](std::size_t begin, std::size_t end) {
        copy_blocks(hessian.pair, moves->data() + begin, moves->data() + end, moves == &turned_,
                    factor_.below);
      });
    some(empty_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        std::fill(factor_.below + empty_[k].begin, factor_.below + empty_[k].end, Block3{});
    });
    const auto pair_block = [&](int pair) {
      const auto [row, column] = model_.pattern.pairs()[std::size_t(pair)];
      return without_fixed(model_, row, column, hessian.pair[std::size_t(pair)].matrix());
    };
    for (const auto& [from, to] : partly_straight_)
      factor_.below[std::size_t(to)].matrix() = pair_block(from);
    for (const auto& [from, to] : partly_turned_)
      factor_.below[std::size_t(to)].matrix() = pair_block(from).transpose();
    for (std::size_t k = 0; k < column_.size(); ++k) {
      Block3& d = factor_.diagonal[k];
      d = hessian.diagonal[std::size_t(column_[k])];
      if (partly_[k]) d.matrix() = without_fixed(model_, column_[k], column_[k], d.matrix());
      add_diagonal(shift, d);
    }
  }

  const Model& model_;
  std::vector<int> order_, position_;  // elimination order of free columns, and its inverse
  std::vector<int> column_;            // column of the model, in elimination order
  std::vector<char> partly_;           // whether some of the column's components are constrained
  // targets of the blocks of pairs, as they are or transposed; blocks of partly constrained columns
  // are copied there again without the constrained components
  std::vector<Move> straight_, turned_, partly_straight_, partly_turned_;
  std::vector<Range> empty_;  // blocks below the diagonal that begin at zero
  BlockFactor factor_;
  mutable std::vector<Entry> work_;  // right-hand side of solve(), in elimination order
};

}  // namespace

std::unique_ptr<LinearSolver> make_block_cholesky(const Model& model) {
  return std::make_unique<BlockCholesky>(model);
}

}  // namespace gridshell
