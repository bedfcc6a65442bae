// Follows one branch of equilibria by its arc length, through states that are not stable, and finds
// where something happens on it.
#pragma once

#include <vector>

#include "engine/record/branches.h"
#include "engine/solve/arc.h"

namespace gridshell::study {

/// Where a branch may be followed to, and how finely.
struct TraceOptions {
  ArcOptions arc;
  double from = 0, to = 1;  ///< of the path parameter: it ends at either
  double max_strain = 1e-3;
  int most_steps = 300;
  int most_pivots = 6;   ///< with more of them below zero it is given up
  double locate = 1e-3;  ///< of a step: to which an event is located
};

/// One equilibrium on the way.
struct TracedPoint {
  PathPoint at;
  int negative_pivots = 0;
  record::BranchEvent event = record::BranchEvent::none;
  int beyond = 0;  ///< of a bifurcation: negative pivots just after it
};

/// Says of a point where something happens whether the branch ends there: it met another one.
using Met = std::function<bool(const TracedPoint&)>;

/// Follows a branch from where `path` stands, the point itself included, until it leaves the range,
/// meets another one, comes to the rods' length or is lost. Bifurcations are located by bisection,
/// limit points by smaller steps; both stand among the points. The last point of a branch that was
/// cancelled is like any other.
std::vector<TracedPoint> trace(Linearisation& system, const PinnedMotion& motion, ArcFollower path,
                               const TraceOptions& options, const Met& met, const Watch& watch);

/// The modes whose stiffness changes its sign at a bifurcation: unit vectors, by inverse iteration
/// on a subspace [Bathe 1996].
std::vector<Eigen::Matrix3Xd> crossing_modes(Linearisation& system, const PinnedMotion& motion,
                                             const TracedPoint& crossing, const Watch& watch);

}  // namespace gridshell::study
