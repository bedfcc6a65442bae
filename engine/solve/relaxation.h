// Baselines that charts compare with, never a default: the explicit integrator and kinetic dynamic
// relaxation.
#pragma once

#include "engine/core/watch.h"
#include "engine/solve/dynamics.h"

namespace gridshell {

/// How a baseline ended: at rest, out of steps, or grown without bound.
enum class BaselineEnd { at_rest, too_slow, blow_up, cancelled };

struct BaselineReport {
  BaselineEnd end = BaselineEnd::too_slow;
  int steps = 0;
  double residual_N = 0;
};

struct BaselineOptions {
  /// of the estimated largest stable step; an estimate: on a strongly bent rod dynamic relaxation
  /// came to rest at 0.5 of it and blew up at 0.8
  double step = 1;
  double damping_per_s = 0;   ///< explicit integrator only
  double tolerance_N = 1e-7;  ///< at rest: no larger force on a free node
  int most_steps = 2000000;
};

/// The largest stable step of the explicit integrator, s: l_min/c, c = sqrt(EA/(mass per length)),
/// over the edges [Courant, Friedrichs, Lewy 1928].
double courant_step(const Model& model, const Eigen::VectorXd& mass);

/// Symplectic Euler with mass-proportional damping, v += h F/m, x += h v, to rest.
BaselineReport explicit_to_rest(const Model& model, const Eigen::VectorXd& mass, Motion& motion,
                                const BaselineOptions& options, const Watch& watch);

/// Kinetic dynamic relaxation [Barnes 1999]: fictitious masses from each node's stiffness, no
/// damping, velocities set to zero at each peak of the kinetic energy.
BaselineReport dynamic_relaxation(const Model& model, Eigen::Matrix3Xd& x,
                                  const BaselineOptions& options, const Watch& watch);

}  // namespace gridshell
