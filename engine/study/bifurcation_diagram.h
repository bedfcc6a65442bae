// Follows one branch of equilibria by its arc length, through states that are not stable, and finds
// where something happens on it.
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/study_tables.h"
#include "engine/solve/arc_follower.h"

namespace gridshell::study {

/// Where a branch may be followed to, and how finely.
struct TraceOptions {
  ArcOptions arc;
  double from = 0, to = 1;  ///< of the path parameter: it ends at either
  double max_strain = 1e-3;
  int most_steps = 300;
  double located = 1e-3;        ///< of a step: to which a bifurcation is bisected
  int after_turn = most_steps;  ///< steps after its first limit point
};

/// One equilibrium of a traced branch.
struct TracedPoint {
  PathPoint at;
  int negative_pivots = 0;
  record::BranchEvent event = record::BranchEvent::none;
  int beyond = 0;  ///< of a bifurcation: negative pivots just after it
};

/// Says of a point where something happens whether the branch ends there: it met another one.
using MeetsBranch = std::function<bool(const TracedPoint&)>;

/// Follows a branch from the current point of `path`, which is included, until it leaves the range,
/// meets another one, reaches the strain limit or is lost. Bifurcations are located by bisection,
/// limit points by smaller steps; both are among the points. The last point of a cancelled branch
/// is an ordinary one.
std::vector<TracedPoint> trace(Linearisation& system, const PinnedMotion& motion, ArcFollower path,
                               const TraceOptions& options, const MeetsBranch& met,
                               const Watch& watch);

/// Columns with a part along any mode: what an iteration on a subspace begins with.
Eigen::MatrixXd generic_vectors(Eigen::Index rows, Eigen::Index count);

/// The modes whose stiffness changes its sign at a bifurcation: unit vectors, by inverse iteration
/// on a subspace [Bathe 1996].
std::vector<Eigen::Matrix3Xd> crossing_modes(Linearisation& system, const PinnedMotion& motion,
                                             const TracedPoint& crossing, const Watch& watch);

// The bifurcation diagram of a preset: its path by arc length, where it loses and regains its
// stability, and the branches that leave there.

struct BranchesOptions {
  int most_branches = 13;  ///< the path itself among them
  int most_steps = 200;    ///< of a branch
};

/// A diagram, on one mesh.
struct BranchDiagram {
  std::vector<record::BranchPoint> points;
  int edges_per_segment = 0;
  int symmetry_order = 0;  ///< of the path's symmetry, 1 to 8; the amplitude is of what breaks it
  double original_radius_mm = record::unknown;  ///< R_o of a circular boundary
  bool of_push = false;                         ///< progress is that of the push
  bool all_followed = true;                     ///< false: more branches were found than followed
};

/// Follows the actuation (from the first buckled state towards the flat and to the end, or from the
/// net backwards), or the push after it, on the finest initial mesh of the tolerance. At every
/// bifurcation the branches along the modes that lost stability are followed on both sides [Keller
/// 1977], each once; `imperfection` has no effect. Errors: bad_input for a preset without a solve,
/// for a path without a start or an actuation that ends before the push; no_equilibrium; cancelled.
Result<BranchDiagram> branches_study(const preset::Preset& preset, const BranchesOptions& options,
                                     Watch& watch);

}  // namespace gridshell::study
