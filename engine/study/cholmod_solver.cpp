#include "engine/study/cholmod_solver.h"

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "engine/elastic/model.h"

namespace gridshell {
namespace {

class CholmodSolver final : public LinearSolver {
 public:
  CholmodSolver(const Model& model, const CholmodOptions& options) : model_(model) {
    cholmod_start(&common_);
    common_.print = 0;
    common_.nmethods = 1;
    common_.method[0].ordering = options.own_ordering ? CHOLMOD_GIVEN : CHOLMOD_METIS;
    common_.postorder = true;
    common_.supernodal = options.supernodal ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
    common_.final_ll = false;
    const auto graph = hessian_graph(model);
    build_pattern(graph);
    std::vector<int> order;
    if (options.own_ordering)
      for (int node : nested_dissection(model, graph))
        for (int c = 0; c < 3; ++c) order.push_back(3 * node + c);
    factor_ = cholmod_analyze_p(matrix_, options.own_ordering ? order.data() : nullptr, nullptr, 0,
                                &common_);
    if (!factor_) throw std::bad_alloc();
  }

  ~CholmodSolver() override {
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_factor(&indefinite_, &common_);
    cholmod_free_sparse(&matrix_, &common_);
    cholmod_finish(&common_);
  }
  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;

  Inertia factor(const BlockHessian& hessian, double shift) override {
    fill(hessian, shift);
    current_ = factor_;
    cholmod_factorize(matrix_, factor_, &common_);
    const bool supernodal = factor_->is_super;
    if (supernodal && common_.status == CHOLMOD_OK) {
      Inertia inertia = read_supernodal();
      if (inertia.usable) return inertia;
    }
    if (!supernodal) return common_.status == CHOLMOD_OK ? read_simplicial(factor_) : Inertia{};

    // not positive definite: the simplicial L D L^T exists, too, and counts the negative pivots
    if (!indefinite_) {
      common_.supernodal = CHOLMOD_SIMPLICIAL;
      common_.method[0].ordering = CHOLMOD_GIVEN;
      std::vector<int> order(static_cast<int*>(factor_->Perm),
                             static_cast<int*>(factor_->Perm) + factor_->n);
      indefinite_ = cholmod_analyze_p(matrix_, order.data(), nullptr, 0, &common_);
      common_.supernodal = CHOLMOD_SUPERNODAL;
    }
    cholmod_factorize(matrix_, indefinite_, &common_);
    current_ = indefinite_;
    return common_.status == CHOLMOD_OK ? read_simplicial(indefinite_) : Inertia{};
  }

  void solve(Eigen::Matrix3Xd& b) const override {
    cholmod_dense* rhs =
        cholmod_allocate_dense(matrix_->nrow, 1, matrix_->nrow, CHOLMOD_REAL, &common_);
    if (!rhs) throw std::bad_alloc();
    auto* values = static_cast<double*>(rhs->x);
    clear_fixed_rows(b);
    for (int k = 0; k < model_.free(); ++k)
      Eigen::Map<Eigen::Vector3d>(values + 3 * k) = b.col(model_.free_columns[std::size_t(k)]);
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, current_, rhs, &common_);
    b.setZero();
    if (x) {
      const auto* found = static_cast<const double*>(x->x);
      for (int k = 0; k < model_.free(); ++k)
        b.col(model_.free_columns[std::size_t(k)]) =
            Eigen::Map<const Eigen::Vector3d>(found + 3 * k);
    }
    cholmod_free_dense(&x, &common_);
    cholmod_free_dense(&rhs, &common_);
  }

  long long blocks() const override { return (long long)(common_.lnz / 9); }

 private:
  /// Lower triangle by columns; `pairs_` has the position of the block of each pair.
  void build_pattern(const std::vector<std::vector<int>>& graph) {
    const int n = int(graph.size());
    long long entries = 0;
    std::vector<std::vector<int>> later(n);
    for (int k = 0; k < n; ++k) {
      for (int other : graph[k])
        if (other > k) later[k].push_back(other);
      std::sort(later[k].begin(), later[k].end());
      entries += 6 + 9 * (long long)later[k].size();
    }
    matrix_ =
        cholmod_allocate_sparse(3 * n, 3 * n, entries, true, true, -1, CHOLMOD_REAL, &common_);
    if (!matrix_) throw std::bad_alloc();
    auto* start = static_cast<int*>(matrix_->p);
    auto* row = static_cast<int*>(matrix_->i);
    int at = 0;
    for (int k = 0; k < n; ++k) {
      for (int c = 0; c < 3; ++c) {
        start[3 * k + c] = at;
        for (int r = c; r < 3; ++r) row[at++] = 3 * k + r;
        for (int other : later[k])
          for (int r = 0; r < 3; ++r) row[at++] = 3 * other + r;
      }
    }
    start[3 * n] = at;
    const auto position_of = [&](int first, int second) {
      const int a = model_.free_index[first], b = model_.free_index[second];
      if (a < 0 || b < 0) return BlockPosition{-1, -1, false};
      const int column = std::min(a, b), other = std::max(a, b);
      const auto& list = later[column];
      return BlockPosition{
          column, int(std::lower_bound(list.begin(), list.end(), other) - list.begin()), a < b};
    };
    for (const auto& [row, column] : model_.pattern.pairs())
      pairs_.push_back(position_of(row, column));
  }

  /// the `rank`-th block below the diagonal block of a block column
  struct BlockPosition {
    int column, rank;
    bool transposed;
  };

  void put(const Eigen::Matrix3d& m, const BlockPosition& at) {
    if (at.column < 0) return;
    const auto* start = static_cast<const int*>(matrix_->p);
    auto* value = static_cast<double*>(matrix_->x);
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r)
        value[start[3 * at.column + c] + (3 - c) + 3 * at.rank + r] =
            at.transposed ? m(c, r) : m(r, c);
  }

  void fill(const BlockHessian& hessian, double shift) {
    const auto* start = static_cast<const int*>(matrix_->p);
    auto* value = static_cast<double*>(matrix_->x);
    for (int k = 0; k < model_.free(); ++k) {
      const int column = model_.free_columns[std::size_t(k)];
      const Eigen::Matrix3d d =
          without_fixed(model_, column, column, hessian.diagonal[std::size_t(column)].matrix());
      for (int c = 0; c < 3; ++c)
        for (int r = c; r < 3; ++r)
          value[start[3 * k + c] + r - c] = d(r, c) + (r == c ? shift : 0);
    }
    const auto& pattern = model_.pattern.pairs();
    for (std::size_t k = 0; k < pairs_.size(); ++k)
      put(without_fixed(model_, pattern[k][0], pattern[k][1], hessian.pair[k].matrix()), pairs_[k]);
  }

  void clear_fixed_rows(Eigen::Matrix3Xd& b) const {
    for (int column : model_.free_columns)
      for (int c = 0; c < 3; ++c)
        if (model_.fixed[std::size_t(column)] >> c & 1) b(c, column) = 0;
  }

  static Inertia read_simplicial(const cholmod_factor* f) {
    Inertia inertia = Inertia::of_nothing();
    const auto* start = static_cast<const int*>(f->p);
    const auto* value = static_cast<const double*>(f->x);
    for (std::size_t k = 0; k < f->n; ++k) inertia.take(value[start[k]]);
    return inertia;
  }

  Inertia read_supernodal() const {
    Inertia inertia = Inertia::of_nothing();
    const auto *super = static_cast<const int*>(factor_->super),
               *pi = static_cast<const int*>(factor_->pi),
               *px = static_cast<const int*>(factor_->px);
    const auto* value = static_cast<const double*>(factor_->x);
    for (std::size_t s = 0; s < factor_->nsuper; ++s) {
      const int rows = pi[s + 1] - pi[s];
      for (int c = 0; c < super[s + 1] - super[s]; ++c) {
        const double root = value[px[s] + c + c * rows];
        inertia.take(root * root);
      }
    }
    return inertia;
  }

  const Model& model_;
  mutable cholmod_common common_{};
  cholmod_sparse* matrix_ = nullptr;
  cholmod_factor* factor_ = nullptr;
  cholmod_factor* indefinite_ = nullptr;  // made when first needed
  cholmod_factor* current_ = nullptr;     // the one of both that factor() computed last
  std::vector<BlockPosition> pairs_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_cholmod(const Model& model, const CholmodOptions& options) {
  return std::make_unique<CholmodSolver>(model, options);
}

}  // namespace gridshell
