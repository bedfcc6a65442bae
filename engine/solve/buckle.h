// The first buckled equilibrium out of the flat, and the next one after a loss of stability.
#pragma once

#include "engine/core/result.h"
#include "engine/footprint/flat_frame.h"
#include "engine/footprint/mesh.h"
#include "engine/solve/path.h"

namespace gridshell {

/// Which of the many buckled shapes a flat footprint is pushed towards.
struct BuckleSeed {
  double up = 1;        ///< +1 or -1
  double diagonal = 1;  ///< +1: the corners on y = x end up lower, -1: those on y = -x
};

/// Mean shortening of the rods with their ends at the motion's t: 1 - sum |chord| / sum length.
double mean_shortening(const RodMesh& mesh, const PinnedMotion& motion, double t);

/// The path parameter at which the mean shortening is `shortening` (may lie beyond 1: the motion
/// goes on). Errors (bad_input) when the motion never shortens the rods that far.
Result<double> parameter_of_shortening(const RodMesh& mesh, const PinnedMotion& motion,
                                       double shortening);

/// A stable equilibrium at t, from the seed's shape: a dome as high as the shortening asks for,
/// tilted along a diagonal, brought to rest with EA scaled by 0.01 and then as it is. Errors:
/// no_equilibrium, cancelled.
Result<State> first_buckled(Linearisation& system, const RodMesh& mesh, const PinnedMotion& motion,
                            double t, const BuckleSeed& seed, const FlatFrame& flat,
                            const Watch& watch);

/// From a state that is not stable, pushed along `mode` (its softest) to either side, to rest; the
/// one of lower energy. Errors: no_equilibrium, cancelled.
Result<State> settle(Linearisation& system, const State& unstable, const Eigen::Matrix3Xd& mode,
                     const Watch& watch);

/// From the last point of a path that lost its stability or turned back: with the motion a little
/// further, at `beyond`, along the mode that went soft. Errors as settle().
Result<State> leave_branch(Linearisation& system, const PinnedMotion& motion, const PathPoint& last,
                           double beyond, const Watch& watch);

/// Softest mode of the Hessian last assembled in `system` by inverse iteration: unit vector over
/// all nodes, zero at pinned ones.
Eigen::Matrix3Xd softest_mode(Linearisation& system);

}  // namespace gridshell
