// Baselines that charts compare with, never a default: the explicit integrator and kinetic dynamic
// relaxation, on the bend rung.
#pragma once

#include "engine/core/outcome.h"
#include "engine/core/watch.h"
#include "engine/solve/dynamics.h"

namespace gridshell::study {

struct BaselineReport {
  Outcome end = Outcome::not_converged;  ///< reached, not_converged, not_finite (grown), cancelled
  int steps = 0;
  double residual_N = 0;
};

struct BaselineOptions {
  /// of the largest stable step: of dynamic relaxation Gershgorin's bound for rods at rest (under
  /// tension they are stiffer), of the explicit integrator l_min/c; implicit: seconds
  double step = 0.9;
  double damping_per_s = 0;   ///< explicit integrator only
  double tolerance_N = 1e-7;  ///< at rest: no larger force on a free node
  int most_steps = 2000000;
};

/// The largest stable step of the explicit integrator, s: l_min/c, c = sqrt(EA/(mass per length)),
/// over the edges [Courant, Friedrichs, Lewy 1928].
double courant_step(const Model& model, const Eigen::Matrix3Xd& mass);

/// Symplectic Euler with mass-proportional damping, v += h F/m, x += h v, to rest.
BaselineReport explicit_to_rest(const Model& model, const Eigen::Matrix3Xd& mass,
                                MovingState& moving, const BaselineOptions& options,
                                const Watch& watch);

/// Kinetic dynamic relaxation [Barnes 1999]: fictitious masses from each node's stiffness, no
/// damping; at each peak of the kinetic energy positions go back to it, velocities to zero, and the
/// next kick is half a one.
BaselineReport dynamic_relaxation(const Model& model, State& state, const BaselineOptions& options,
                                  const Watch& watch);

/// Implicit Euler, m (v1 - v0)/h = F(x1) - c m v1, x1 = x0 + h v1, a whole Newton solve a step, to
/// rest: large steps damp by themselves. `options.step` is h in seconds. A step that Newton's
/// method does not solve ends it as `not_converged` with the steps so far.
BaselineReport implicit_to_rest(const Model& model, const Eigen::Matrix3Xd& mass,
                                MovingState& moving, const BaselineOptions& options,
                                const Watch& watch);

}  // namespace gridshell::study
