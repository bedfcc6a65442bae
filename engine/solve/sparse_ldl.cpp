#include "engine/solve/sparse_ldl.h"

#include <cholmod.h>

#include <algorithm>
#include <cmath>

namespace gridshell {

struct SparseLdl::Cholmod {
  cholmod_common common{};
  cholmod_sparse* matrix = nullptr;
  cholmod_factor* factor = nullptr;
};

SparseLdl::SparseLdl(const Eigen::SparseMatrix<double>& pattern)
    : cholmod_(std::make_unique<Cholmod>()) {
  cholmod_common& common = cholmod_->common;
  cholmod_start(&common);
  common.print = 0;
  common.supernodal = CHOLMOD_SIMPLICIAL;
  common.final_ll = false;
  common.nmethods = 2;
  common.method[0].ordering = CHOLMOD_AMD;
  common.method[1].ordering = CHOLMOD_METIS;
  common.postorder = true;
  const std::size_t n = std::size_t(pattern.cols());
  cholmod_->matrix = cholmod_allocate_sparse(n, n, std::size_t(pattern.nonZeros()), true, true, -1,
                                             CHOLMOD_REAL, &common);
  std::copy_n(pattern.outerIndexPtr(), n + 1, static_cast<int*>(cholmod_->matrix->p));
  std::copy_n(pattern.innerIndexPtr(), pattern.nonZeros(), static_cast<int*>(cholmod_->matrix->i));
  cholmod_->factor = cholmod_analyze(cholmod_->matrix, &common);
}

SparseLdl::~SparseLdl() {
  cholmod_free_factor(&cholmod_->factor, &cholmod_->common);
  cholmod_free_sparse(&cholmod_->matrix, &cholmod_->common);
  cholmod_finish(&cholmod_->common);
}

Inertia SparseLdl::factor(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& shift) {
  auto* value = static_cast<double*>(cholmod_->matrix->x);
  std::copy_n(matrix.valuePtr(), matrix.nonZeros(), value);
  // the diagonal leads each column of a lower triangle
  for (Eigen::Index k = 0; k < matrix.cols(); ++k) value[matrix.outerIndexPtr()[k]] += shift[k];
  cholmod_factorize(cholmod_->matrix, cholmod_->factor, &cholmod_->common);
  if (cholmod_->common.status != CHOLMOD_OK) return {};
  Inertia inertia{0, true, 1e300, 0};
  const auto* start = static_cast<const int*>(cholmod_->factor->p);
  const auto* pivots = static_cast<const double*>(cholmod_->factor->x);
  for (std::size_t k = 0; k < cholmod_->factor->n; ++k) {
    const double pivot = pivots[start[k]], size = std::abs(pivot);
    if (!(size > 1e-300 && size < 1e300)) inertia.usable = false;
    inertia.negative_pivots += pivot < 0;
    inertia.smallest_pivot = std::min(inertia.smallest_pivot, size);
    inertia.largest_pivot = std::max(inertia.largest_pivot, size);
  }
  return inertia;
}

Eigen::VectorXd SparseLdl::solve(const Eigen::VectorXd& right_hand_side) const {
  cholmod_dense b{};
  b.nrow = b.d = b.nzmax = std::size_t(right_hand_side.size());
  b.ncol = 1;
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  b.x = const_cast<double*>(right_hand_side.data());  // read only
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, cholmod_->factor, &b, &cholmod_->common);
  Eigen::VectorXd found = Eigen::VectorXd::Zero(right_hand_side.size());
  if (x) found = Eigen::Map<const Eigen::VectorXd>(static_cast<double*>(x->x), found.size());
  cholmod_free_dense(&x, &cholmod_->common);
  return found;
}

}  // namespace gridshell
