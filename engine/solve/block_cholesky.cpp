// 3x3-block Cholesky L D L^T by panels, columns beside one another that have the same rows below
// them [supernodes: Ng, Peyton 1993]. The structure is fixed, so every block update has its place
// worked out once: a panel is finished, then subtracts its outer product from the columns right of
// it (right-looking), each target read and written once a panel.
#include <algorithm>
#include <utility>

#include "engine/core/block3.h"
#include "engine/solve/linear_solver.h"

namespace gridshell {
namespace {

/// A node's part of a right-hand side. (std::vector<Column> would forget the alignment.)
struct alignas(32) Entry {
  Column value;
};
static_assert(alignof(Entry) == 32 && sizeof(Entry) == sizeof(Column));

constexpr int widest_panel = 8;  // columns; wider ones would not stay in the nearest cache

/// The plan and the numbers of one factor; plain arrays for the loops below.
struct Factor {
  int columns = 0;
  std::vector<int> first;  // columns + 1: first off-diagonal block of each column
  std::vector<int> row;    // its row (in elimination order)
  std::vector<int> panel;  // first column of each, and columns
  // per pair (a <= b) of the rows below a panel: block that it updates, or ~block where nothing
  // stands there before
  std::vector<int> target;
  std::vector<long long> first_target;  // per panel
  std::vector<Block3> diagonal, below;  // targets < columns are diagonal, the rest is below
  std::vector<Entry> inverse;           // of the pivots
};

/// L D L^T of a diagonal block in place: L below the diagonal, whose ones are not kept, D on it;
/// returns false for a pivot that cannot be used. Nothing but the pivots' inverses is divided for,
/// as columns wait for one another.
inline bool factor_diagonal(Block3& m, Column& inverse, Inertia& inertia) {
  Column* d = m.column;
  inverse[0] = 1 / d[0][0];
  const double l10 = d[0][1] * inverse[0], l20 = d[0][2] * inverse[0];
  d[1][1] -= l10 * d[0][1];
  const double c21 = d[1][2] - l20 * d[0][1];
  inverse[1] = 1 / d[1][1];
  const double l21 = c21 * inverse[1];
  d[2][2] -= l20 * d[0][2] + l21 * c21;
  inverse[2] = 1 / d[2][2];
  d[0][1] = l10;
  d[0][2] = l20;
  d[1][2] = l21;
  for (int k = 0; k < 3; ++k) inertia.take(d[k][k]);
  return inertia.usable;
}

/// Column k of L, once nothing more is subtracted from it.
inline bool finish_column(Factor& f, int k, Inertia& inertia) {
  const Column* d = f.diagonal[k].column;
  const Column& inverse = f.inverse[k].value;
  if (!factor_diagonal(f.diagonal[k], f.inverse[k].value, inertia)) return false;
  const double l10 = d[0][1], l20 = d[0][2], l21 = d[1][2];
  for (int i = f.first[k]; i < f.first[k + 1]; ++i) {
    Column* b = f.below[i].column;
    b[1] -= l10 * b[0];
    b[2] -= l20 * b[0] + l21 * b[1];
    for (int j = 0; j < 3; ++j) b[j] *= inverse[j];
  }
  return true;
}

/// L_a D of one block of column k, by entries.
struct Scaled {
  double entry[3][3];
  inline void take(const Factor& f, int k, const Block3& la) {
    const Column* d = f.diagonal[k].column;
    for (int i = 0; i < 3; ++i) {
      const Column m = la.column[i] * d[i][i];
      for (int j = 0; j < 3; ++j) entry[i][j] = m[j];
    }
  }
};

/// target -= L_b D L_a^T, from zero where it begins so
template <bool begins = false>
inline void subtract(const Block3& lb, const Scaled& la, Block3& target) {
  for (int j = 0; j < 3; ++j) {
    const Column product = lb.column[0] * la.entry[0][j] + lb.column[1] * la.entry[1][j] +
                           lb.column[2] * la.entry[2][j];
    target.column[j] = begins ? -product : target.column[j] - product;
  }
}

/// The same for `tile` targets and the columns of a panel, whose blocks stand at lb[column][0 ...].
template <int tile>
inline void subtract_panel(const Block3* const* lb, const Scaled* la, int width, const int* target,
                           Block3* below) {
  Column sum[tile][3];
  for (int t = 0; t < tile; ++t)
    for (int j = 0; j < 3; ++j) sum[t][j] = below[target[t]].column[j];
  for (int c = 0; c < width; ++c)
    for (int i = 0; i < 3; ++i)
      for (int t = 0; t < tile; ++t)
        for (int j = 0; j < 3; ++j) sum[t][j] -= lb[c][t].column[i] * la[c].entry[i][j];
  for (int t = 0; t < tile; ++t)
    for (int j = 0; j < 3; ++j) below[target[t]].column[j] = sum[t][j];
}

/// Subtracts a column's outer product from the rest of its panel, which ends before column `end`.
inline void update_within(Factor& f, int k, int end) {
  Scaled la;
  for (int a = k + 1; a < end; ++a) {
    const Block3* lb = &f.below[f.first[k] + a - k - 1];
    la.take(f, k, *lb);
    subtract(*lb, la, f.diagonal[a]);
    const int rows = f.first[a + 1] - f.first[a];
    for (int i = 0; i < rows; ++i) subtract(lb[1 + i], la, f.below[f.first[a] + i]);
  }
}

/// Subtracts the outer product of a panel of one column.
inline void update_narrow(Factor& f, int k, const int* target) {
  Scaled la;
  for (int a = f.first[k]; a < f.first[k + 1]; ++a) {
    la.take(f, k, f.below[a]);
    subtract(f.below[a], la, f.diagonal[*target++]);
    for (int b = a + 1; b < f.first[k + 1]; ++b) {
      const int to = *target++;
      if (to < 0)
        subtract<true>(f.below[b], la, f.below[~to]);
      else
        subtract(f.below[b], la, f.below[to]);
    }
  }
}

/// Subtracts the outer product of the panel of columns `begin` to `end`.
inline void update_wide(Factor& f, int begin, int end, const int* target) {
  const int width = end - begin, rows = f.first[end] - f.first[end - 1];
  const Block3* lb[widest_panel];
  Scaled la[widest_panel];
  for (int a = 0; a < rows; ++a) {
    for (int c = 0; c < width; ++c) {
      lb[c] = &f.below[f.first[begin + c + 1] - rows + a];
      la[c].take(f, begin + c, *lb[c]);
    }
    const auto next = [&](int tile) {
      target += tile;
      for (int c = 0; c < width; ++c) lb[c] += tile;
    };
    subtract_panel<1>(lb, la, width, target, f.diagonal.data());
    next(1);
    int left = rows - a - 1;
    for (; left >= 3; left -= 3, next(3)) subtract_panel<3>(lb, la, width, target, f.below.data());
    for (; left > 0; --left, next(1)) subtract_panel<1>(lb, la, width, target, f.below.data());
  }
}

GRIDSHELL_CLONES
void factor_numbers(Factor& f, int most_negative, Inertia& inertia) {
  for (std::size_t p = 0; p + 1 < f.panel.size(); ++p) {
    const int begin = f.panel[p], end = f.panel[p + 1];
    for (int k = begin; k < end; ++k) {
      if (!finish_column(f, k, inertia)) return;
      if (inertia.negative_pivots > most_negative) return;
      update_within(f, k, end);
    }
    const int* target = f.target.data() + f.first_target[p];
    if (end - begin == 1)
      update_narrow(f, begin, target);
    else
      update_wide(f, begin, end, target);
  }
}

GRIDSHELL_CLONES
void solve_numbers(const Factor& f, Entry* x) {
  for (int k = 0; k < f.columns; ++k) {
    const Column* d = f.diagonal[k].column;
    Column& v = x[k].value;
    v[1] -= d[0][1] * v[0];
    v[2] -= d[0][2] * v[0] + d[1][2] * v[1];
    const Column value = v;
    for (int i = f.first[k]; i < f.first[k + 1]; ++i) {
      const Column* b = f.below[i].column;
      x[f.row[i]].value -= b[0] * value[0] + b[1] * value[1] + b[2] * value[2];
    }
    v = value * f.inverse[k].value;
  }
  for (int k = f.columns - 1; k >= 0; --k) {
    const Column* d = f.diagonal[k].column;
    Column sum[3] = {};
    for (int i = f.first[k]; i < f.first[k + 1]; ++i) {
      const Column* b = f.below[i].column;
      for (int j = 0; j < 3; ++j) sum[j] += b[j] * x[f.row[i]].value;
    }
    Column& v = x[k].value;
    for (int j = 0; j < 3; ++j) v[j] -= sum[j][0] + sum[j][1] + sum[j][2];
    v[1] -= d[1][2] * v[2];
    v[0] -= d[0][1] * v[1] + d[0][2] * v[2];
  }
}

/// Where a block of the Hessian goes: from the pair `from` to the block `to` below the diagonal.
struct Move {
  int from, to;
};

/// Blocks begin to end below the diagonal.
struct Range {
  int begin, end;
};

GRIDSHELL_CLONES
void copy_blocks(const std::vector<Block3>& pair, const std::vector<Move>& straight,
                 const std::vector<Move>& turned, std::vector<Block3>& below) {
  for (const auto& [from, to] : straight) below[std::size_t(to)] = pair[std::size_t(from)];
  for (const auto& [from, to] : turned) transpose(pair[std::size_t(from)], below[std::size_t(to)]);
}

class BlockCholesky final : public LinearSolver {
 public:
  explicit BlockCholesky(const Model& model) : model_(model) {
    const auto graph = hessian_graph(model);
    order_ = nested_dissection(model, graph);
    place_.resize(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) {
      place_[order_[k]] = int(k);
      column_.push_back(model.free_columns[std::size_t(order_[k])]);
    }
    find_structure(graph);
    find_panels();
    plan_updates();
    plan_first_updates(plan_copies());
  }

  Inertia factor(const BlockHessian& hessian, double shift) override {
    fill(hessian, shift);
    Inertia inertia = Inertia::of_nothing();
    factor_numbers(factor_, most_negative, inertia);
    return inertia;
  }

  void solve(Eigen::Matrix3Xd& b) const override {
    work_.resize(order_.size());
    std::vector<Entry>& x = work_;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      load(b.col(column_[k]), x[k].value);
      for (int c = 0; partly_[k] && c < 3; ++c)
        if (model_.held[std::size_t(column_[k])] >> c & 1) x[k].value[c] = 0;
    }
    solve_numbers(factor_, x.data());
    b.setZero();
    for (std::size_t k = 0; k < order_.size(); ++k)
      b.col(column_[k]) << x[k].value[0], x[k].value[1], x[k].value[2];
  }

  long long blocks() const override {
    return (long long)(factor_.below.size() + factor_.diagonal.size());
  }

 private:
  /// rows below the diagonal of each column of L, in elimination order: the Hessian's own and those
  /// of the columns whose first row it is, its children in the elimination tree
  void find_structure(const std::vector<std::vector<int>>& graph) {
    const int n = int(order_.size());
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
      for (int other : graph[order_[k]]) take(place_[other]);
      for (int child = last_child[k]; child >= 0; child = child_before[child])
        for (int i = factor_.first[child]; i < factor_.first[child + 1]; ++i) take(rows[i]);
      std::sort(rows.begin() + long(begin), rows.end());
      factor_.first.push_back(int(rows.size()));
      if (rows.size() > begin) child_before[k] = std::exchange(last_child[rows[begin]], k);
    }
    factor_.diagonal.resize(std::size_t(n));
    factor_.inverse.resize(std::size_t(n));
    factor_.below.resize(rows.size());
  }

  int slot(int row, int column) const {
    const auto begin = factor_.row.begin() + factor_.first[column],
               end = factor_.row.begin() + factor_.first[column + 1];
    return int(std::lower_bound(begin, end, row) - factor_.row.begin());
  }

  int rows_below(int column) const { return factor_.first[column + 1] - factor_.first[column]; }

  void find_panels() {
    std::vector<int>& panel = factor_.panel;
    for (int k = 0; k < factor_.columns; ++k) {
      const bool same =
          k > 0 && rows_below(k - 1) == rows_below(k) + 1 && factor_.row[factor_.first[k - 1]] == k;
      if (!same || k - panel.back() == widest_panel) panel.push_back(k);
    }
    panel.push_back(factor_.columns);
  }

  void plan_updates() {
    std::size_t updates = 0;
    for (std::size_t p = 0; p + 1 < factor_.panel.size(); ++p) {
      const std::size_t rows = std::size_t(rows_below(factor_.panel[p + 1] - 1));
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

  /// returns which blocks below the diagonal the Hessian has
  std::vector<char> plan_copies() {
    std::vector<char> filled(factor_.below.size(), 0);
    const auto& pattern = model_.pattern.pairs();
    for (int k = 0; k < int(pattern.size()); ++k) {
      const auto [row, column] = pattern[std::size_t(k)];
      const int a = model_.free_index[std::size_t(row)], b = model_.free_index[std::size_t(column)];
      if (a < 0 || b < 0) continue;
      // the block is stored with the later node as row
      const bool turn = place_[a] < place_[b];
      const int to = turn ? slot(place_[b], place_[a]) : slot(place_[a], place_[b]);
      filled[std::size_t(to)] = 1;
      const bool partly = model_.held[std::size_t(row)] || model_.held[std::size_t(column)];
      (turn ? turned_ : straight_).push_back({k, to});
      if (partly) (turn ? partly_turned_ : partly_straight_).push_back({k, to});
    }
    for (int column : column_) partly_.push_back(model_.held[std::size_t(column)] != 0);
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
      const int rows = rows_below(end - 1);
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
    copy_blocks(hessian.pair, straight_, turned_, factor_.below);
    for (const auto& [begin, end] : empty_)
      std::fill(factor_.below.begin() + begin, factor_.below.begin() + end, Block3{});
    const auto held_pair = [&](int pair) {
      const auto [row, column] = model_.pattern.pairs()[std::size_t(pair)];
      return without_held(model_, row, column, hessian.pair[std::size_t(pair)].matrix());
    };
    for (const auto& [from, to] : partly_straight_)
      factor_.below[std::size_t(to)].matrix() = held_pair(from);
    for (const auto& [from, to] : partly_turned_)
      factor_.below[std::size_t(to)].matrix() = held_pair(from).transpose();
    for (std::size_t k = 0; k < column_.size(); ++k) {
      Block3& d = factor_.diagonal[k];
      d = hessian.diagonal[std::size_t(column_[k])];
      if (partly_[k]) d.matrix() = without_held(model_, column_[k], column_[k], d.matrix());
      add_diagonal(shift, d);
    }
  }

  const Model& model_;
  std::vector<int> order_, place_;  // elimination order of free columns, and its inverse
  std::vector<int> column_;         // of the model, in elimination order
  std::vector<char> partly_;        // whether some of it is held
  // where the blocks of pairs go, as they are or transposed; those of columns that are partly held
  // go there again without what is held
  std::vector<Move> straight_, turned_, partly_straight_, partly_turned_;
  std::vector<Range> empty_;  // blocks below the diagonal that begin at zero
  Factor factor_;
  mutable std::vector<Entry> work_;  // of solve()
};

}  // namespace

std::unique_ptr<LinearSolver> make_block_cholesky(const Model& model) {
  return std::make_unique<BlockCholesky>(model);
}

}  // namespace gridshell
