// Sparse L D L^T of a symmetric matrix of any pattern, with its inertia.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

#include "engine/solve/linear_solver.h"

namespace gridshell {

/// CHOLMOD's simplicial factorisation [Chen, Davis, Hager, Rajamanickam 2008], the order by
/// minimum degree or nested dissection, whichever fills less; analysed once. Not thread-safe.
class SparseLdl {
 public:
  /// `pattern`: lower triangle, compressed; its values do not matter.
  explicit SparseLdl(const Eigen::SparseMatrix<double>& pattern);
  ~SparseLdl();
  SparseLdl(const SparseLdl&) = delete;
  SparseLdl& operator=(const SparseLdl&) = delete;

  /// Factorises `matrix` (same pattern) + diag(shift). Pivots are not exchanged: `usable` is false
  /// where one is zero.
  Inertia factor(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& shift);
  /// Solves with the last factor(), which must have been usable.
  Eigen::VectorXd solve(const Eigen::VectorXd& right_hand_side) const;

 private:
  struct Cholmod;
  std::unique_ptr<Cholmod> cholmod_;
};

}  // namespace gridshell
