// Lowest modes of a state: the vibration modes and the mode of the lowest stability.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/solve/newton.h"

namespace gridshell {

/// Pairs K v = lambda M v in ascending order of lambda; v^T M v = 1.
struct Eigenmodes {
  Eigen::VectorXd values;
  std::vector<Eigen::Matrix3Xd> shapes;  ///< over all columns; constrained components are zero
  std::vector<double> residuals;         ///< |K v - lambda M v| / |lambda M v|
};

/// The `count` modes of smallest lambda of K v = lambda M v: K is the Hessian of the energy that
/// `system` was last factorised with, on the unconstrained components; M is the diagonal `mass`,
/// one entry per unknown, zero for unknowns that follow. If the number `negative` of eigenvalues
/// below zero (by the inertia) exceeds `count`, those nearest to zero are computed. Lanczos' method
/// on M^1/2 K^-1 M^1/2 [Ericsson, Ruhe 1980] is repeated orthogonal to the modes found until none
/// is nearer to zero: a single start vector misses equal eigenvalues, which symmetric shells have
/// in pairs. Returns fewer than `count` if fewer unknowns have mass. Errors: cancelled;
/// no_equilibrium if it does not converge.
Result<Eigenmodes> softest_modes(const Linearisation& system, const Eigen::Matrix3Xd& mass,
                                 int count, int negative, const Watch& watch);

}  // namespace gridshell
