// The softest modes of a state: what a shell vibrates in, and what it would lose its stability by.
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
  std::vector<Eigen::Matrix3Xd> shapes;  ///< over all columns; what is held does not move
  std::vector<double> residuals;         ///< |K v - lambda M v| / |lambda M v|
};

/// The `count` modes of smallest lambda, K the energy's Hessian that `system` was factorised with
/// last, with what is held held, M the diagonal `mass`, one an unknown; unknowns without one
/// follow. Of `negative` eigenvalues below zero (the inertia tells how many) those nearest to it
/// come first. By Lanczos' method on M^1/2 K^-1 M^1/2 [Ericsson, Ruhe 1980], and again beside what
/// was found until nothing more is nearer to zero: one vector alone misses equal eigenvalues, which
/// symmetric shells have in pairs. Fewer than `count` where there are no more unknowns with mass.
/// Errors: cancelled; no_equilibrium where it does not converge.
Result<Eigenmodes> softest_modes(const Linearisation& system, const Eigen::Matrix3Xd& mass,
                                 int count, int negative, const Watch& watch);

}  // namespace gridshell
