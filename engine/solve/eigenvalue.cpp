#include "engine/solve/eigenvalue.h"

#include <cmath>
#include <limits>

namespace gridshell {
namespace {

/// L v over all columns.
Eigen::Matrix3Xd weighted(const Eigen::Matrix3Xd& v, const Eigen::VectorXd& length) {
  Eigen::Matrix3Xd product = Eigen::Matrix3Xd::Zero(3, v.cols());
  product.leftCols(length.size()) = v.leftCols(length.size()) * length.asDiagonal();
  return product;
}

}  // namespace

double lowest_eigenvalue(Linearisation& system, const State& state, const Eigen::VectorXd& length,
                         const Watch& watch, double converged) {
  constexpr int most_iterations = 200;
  if (!system.at(state, false).positive_definite()) return std::numeric_limits<double>::quiet_NaN();
  // a start with a part along any mode
  Eigen::Matrix3Xd v(3, system.model().columns());
  for (Eigen::Index k = 0; k < v.size(); ++k) v.data()[k] = std::sin(1 + 1.7 * double(k));
  double lambda = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most_iterations && !watch.cancelled(); ++k) {
    Eigen::Matrix3Xd next = weighted(v, length);
    const Eigen::Matrix3Xd force = next;
    system.solve(next);
    // Rayleigh's quotient of the new vector: H next = force
    const double before =
        std::exchange(lambda, product(next, force) / product(next, weighted(next, length)));
    v = next / next.norm();
    if (std::abs(before - lambda) <= converged * lambda) break;
  }
  return lambda;
}

}  // namespace gridshell
