// 3x3-block signed Cholesky. The structure is fixed, so every block update has its place worked out
// once: column k of the factor is finished, then subtracts its outer product from the columns right
// of it (right-looking), its blocks read in a row and the targets listed one after another.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "engine/core/clones.h"
#include "engine/solve/linear_solver.h"
#include "engine/solve/ordering.h"

namespace gridshell {
namespace {

// x, y, z and a zero. The alignment is stated, as the clones below would each assume their own.
typedef double Column __attribute__((vector_size(32), aligned(32)));

/// A 3x3 block by columns.
struct alignas(32) Block3 {
  Column column[3];
};

/// A node's part of a right-hand side. (std::vector<Column> would forget the alignment.)
struct alignas(32) Entry {
  Column value;
};
static_assert(alignof(Block3) == 32 && alignof(Entry) == 32 && sizeof(Entry) == sizeof(Column));

/// The plan and the numbers of one factor; plain arrays for the loops below.
struct Factor {
  int columns = 0;
  std::vector<int> first;   // columns + 1: first off-diagonal block of each column
  std::vector<int> row;     // its row (in elimination order)
  std::vector<int> target;  // per pair (a <= b) of a column's rows: block that it updates
  std::vector<long long> first_target;  // per column
  std::vector<Block3> diagonal, below;  // targets < columns are diagonal, the rest is below
  std::vector<std::array<double, 3>> sign;
};

/// L S L^T of a diagonal block in place (lower part); returns false for a pivot that cannot be
/// used.
inline bool factor_diagonal(Block3& d, std::array<double, 3>& sign, Inertia& inertia) {
  for (int k = 0; k < 3; ++k) {
    double pivot = d.column[k][k];
    for (int m = 0; m < k; ++m) pivot -= d.column[m][k] * d.column[m][k] * sign[m];
    const double size = std::abs(pivot);
    if (!(size > 1e-300 && size < 1e300)) return false;
    sign[k] = pivot < 0 ? -1.0 : 1.0;
    inertia.negative_pivots += pivot < 0;
    inertia.smallest_pivot = std::min(inertia.smallest_pivot, size);
    inertia.largest_pivot = std::max(inertia.largest_pivot, size);
    const double root = std::sqrt(size);
    d.column[k][k] = root;
    for (int i = k + 1; i < 3; ++i) {
      double value = d.column[k][i];
      for (int m = 0; m < k; ++m) value -= d.column[m][i] * d.column[m][k] * sign[m];
      d.column[k][i] = value * sign[k] / root;
    }
  }
  return true;
}

GRIDSHELL_CLONES
bool factor_numbers(Factor& f, Inertia& inertia) {
  for (int k = 0; k < f.columns; ++k) {
    Block3& d = f.diagonal[k];
    std::array<double, 3>& s = f.sign[k];
    if (!factor_diagonal(d, s, inertia)) return false;
    const double r0 = s[0] / d.column[0][0], r1 = s[1] / d.column[1][1], r2 = s[2] / d.column[2][2];
    const double l10 = d.column[0][1] * s[0], l20 = d.column[0][2] * s[0],
                 l21 = d.column[1][2] * s[1];
    const int begin = f.first[k], end = f.first[k + 1];
    for (int i = begin; i < end; ++i) {
      Block3& b = f.below[i];
      b.column[0] *= r0;
      b.column[1] = (b.column[1] - l10 * b.column[0]) * r1;
      b.column[2] = (b.column[2] - l20 * b.column[0] - l21 * b.column[1]) * r2;
    }
    const int* target = f.target.data() + f.first_target[k];
    for (int a = begin; a < end; ++a) {
      const Block3& la = f.below[a];
      const Column m0 = la.column[0] * s[0], m1 = la.column[1] * s[1], m2 = la.column[2] * s[2];
      Block3* place = &f.diagonal[*target++];
      for (int b = a;;) {
        const Block3& lb = f.below[b];
        for (int j = 0; j < 3; ++j)
          place->column[j] -= lb.column[0] * m0[j] + lb.column[1] * m1[j] + lb.column[2] * m2[j];
        if (++b == end) break;
        place = &f.below[*target++];
      }
    }
  }
  return true;
}

GRIDSHELL_CLONES
void solve_numbers(const Factor& f, Entry* x) {
  for (int k = 0; k < f.columns; ++k) {
    const Block3& d = f.diagonal[k];
    Column v = x[k].value;
    v[0] = v[0] / d.column[0][0];
    v[1] = (v[1] - d.column[0][1] * v[0]) / d.column[1][1];
    v[2] = (v[2] - d.column[0][2] * v[0] - d.column[1][2] * v[1]) / d.column[2][2];
    x[k].value = v;
    for (int i = f.first[k]; i < f.first[k + 1]; ++i) {
      const Block3& b = f.below[i];
      x[f.row[i]].value -= b.column[0] * v[0] + b.column[1] * v[1] + b.column[2] * v[2];
    }
  }
  for (int k = f.columns - 1; k >= 0; --k) {
    const Block3& d = f.diagonal[k];
    Column sum[3] = {};
    for (int i = f.first[k]; i < f.first[k + 1]; ++i) {
      const Block3& b = f.below[i];
      const Column y = x[f.row[i]].value;
      for (int j = 0; j < 3; ++j) sum[j] += b.column[j] * y;
    }
    Column v = x[k].value;
    for (int j = 0; j < 3; ++j) v[j] = v[j] * f.sign[k][j] - (sum[j][0] + sum[j][1] + sum[j][2]);
    v[2] = v[2] / d.column[2][2];
    v[1] = (v[1] - d.column[1][2] * v[2]) / d.column[1][1];
    v[0] = (v[0] - d.column[0][1] * v[1] - d.column[0][2] * v[2]) / d.column[0][0];
    x[k].value = v;
  }
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
    const auto structure = eliminate(graph);
    lay_out(structure);
    plan_updates(structure);
    plan_scatter();
  }

  Inertia factor(const BlockHessian& hessian, double shift) override {
    scatter(hessian, shift);
    Inertia inertia;
    inertia.smallest_pivot = 1e300;
    inertia.usable = factor_numbers(factor_, inertia);
    return inertia;
  }

  void solve(Eigen::Matrix3Xd& b) const override {
    work_.resize(order_.size());
    std::vector<Entry>& x = work_;
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const auto v = b.col(column_[k]);
      x[k].value = Column{v[0], v[1], v[2], 0};
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
  using Structure = std::vector<std::vector<int>>;

  /// rows below the diagonal of each column of L, in elimination order
  Structure eliminate(const std::vector<std::vector<int>>& graph) const {
    const int n = int(order_.size());
    Structure structure(n);
    std::vector<std::vector<int>> children(n);
    std::vector<int> seen(n, -1);
    for (int k = 0; k < n; ++k) {
      std::vector<int>& rows = structure[k];
      seen[k] = k;
      const auto take = [&](int row) {
        if (row > k && seen[row] != k) seen[row] = k, rows.push_back(row);
      };
      for (int other : graph[order_[k]]) take(place_[other]);
      for (int child : children[k])
        for (int row : structure[child]) take(row);
      std::sort(rows.begin(), rows.end());
      if (!rows.empty()) children[rows.front()].push_back(k);
    }
    return structure;
  }

  void lay_out(const Structure& structure) {
    factor_.columns = int(structure.size());
    factor_.first.assign(1, 0);
    for (const auto& rows : structure) {
      factor_.row.insert(factor_.row.end(), rows.begin(), rows.end());
      factor_.first.push_back(int(factor_.row.size()));
    }
    factor_.diagonal.resize(structure.size());
    factor_.below.resize(factor_.row.size());
    factor_.sign.resize(structure.size());
  }

  int slot(int row, int column) const {
    const auto begin = factor_.row.begin() + factor_.first[column],
               end = factor_.row.begin() + factor_.first[column + 1];
    return int(std::lower_bound(begin, end, row) - factor_.row.begin());
  }

  void plan_updates(const Structure& structure) {
    for (const auto& rows : structure) {
      factor_.first_target.push_back((long long)factor_.target.size());
      for (std::size_t a = 0; a < rows.size(); ++a) {
        factor_.target.push_back(rows[a]);
        // the rows of column rows[a] contain all later rows of this one: walk both at once
        int at = factor_.first[rows[a]];
        for (std::size_t b = a + 1; b < rows.size(); ++b) {
          while (factor_.row[at] != rows[b]) ++at;
          factor_.target.push_back(at);
        }
      }
    }
  }

  void plan_scatter() {
    const auto plan = [&](int first, int second) {
      const int a = model_.free_index[first], b = model_.free_index[second];
      if (a < 0 || b < 0) return Scatter{-1, false};
      const int ka = place_[a], kb = place_[b];
      // the block's row is `first`; it is stored below the diagonal with the later node as row
      return ka > kb ? Scatter{slot(ka, kb), false} : Scatter{slot(kb, ka), true};
    };
    for (const auto& [row, column] : model_.pattern.pairs()) pairs_.push_back(plan(row, column));
    for (int column : column_) partly_.push_back(model_.held[std::size_t(column)] != 0);
  }

  struct Scatter {
    int slot;
    bool transposed;
  };

  static void put(const Eigen::Matrix3d& m, bool transposed, Block3& b) {
    for (int c = 0; c < 3; ++c)
      b.column[c] =
          transposed ? Column{m(c, 0), m(c, 1), m(c, 2), 0} : Column{m(0, c), m(1, c), m(2, c), 0};
  }

  bool partly_held(int column) const { return model_.held[std::size_t(column)] != 0; }

  void scatter(const BlockHessian& hessian, double shift) {
    std::memset(static_cast<void*>(factor_.below.data()), 0, factor_.below.size() * sizeof(Block3));
    for (std::size_t k = 0; k < column_.size(); ++k) {
      Block3& d = factor_.diagonal[k];
      const int column = column_[k];
      const Eigen::Matrix3d& own = hessian.diagonal[std::size_t(column)];
      put(partly_[k] ? without_held(model_, column, column, own) : own, false, d);
      for (int c = 0; c < 3; ++c) d.column[c][c] += shift;
    }
    const auto& pattern = model_.pattern.pairs();
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      if (pairs_[k].slot < 0) continue;
      const auto [row, column] = pattern[k];
      const Eigen::Matrix3d& own = hessian.pair[k];
      const bool partly = partly_held(row) || partly_held(column);
      put(partly ? without_held(model_, row, column, own) : own, pairs_[k].transposed,
          factor_.below[std::size_t(pairs_[k].slot)]);
    }
  }

  const Model& model_;
  std::vector<int> order_, place_;  // elimination order of free columns, and its inverse
  std::vector<int> column_;         // of the model, in elimination order
  std::vector<char> partly_;        // whether some of it is held
  std::vector<Scatter> pairs_;      // where each pair's block goes
  Factor factor_;
  mutable std::vector<Entry> work_;  // of solve()
};

}  // namespace

std::unique_ptr<LinearSolver> make_block_cholesky(const Model& model) {
  return std::make_unique<BlockCholesky>(model);
}

}  // namespace gridshell
