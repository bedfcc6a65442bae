#include "engine/solve/linear_solver.h"

namespace gridshell {

std::unique_ptr<LinearSolver> make_pattern_solver(const Model& model) {
  constexpr int measured = 1000000;  // degrees of freedom
  return model.dof() <= measured ? make_block_cholesky(model) : make_cholmod(model);
}

Eigen::Matrix3d without_held(const Model& model, int row, int column,
                             const Eigen::Matrix3d& block) {
  Eigen::Matrix3d m = block;
  for (int k = 0; k < 3; ++k) {
    if (model.held[std::size_t(row)] >> k & 1) m.row(k).setZero();
    if (model.held[std::size_t(column)] >> k & 1) m.col(k).setZero();
    if (row == column && model.held[std::size_t(row)] >> k & 1) m(k, k) = 1;
  }
  return m;
}

}  // namespace gridshell
