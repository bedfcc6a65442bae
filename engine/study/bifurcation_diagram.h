// Branches of equilibria followed by arc length, also through unstable states, with the events on
// them, and the bifurcation diagram that they form.
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/study_tables.h"
#include "engine/solve/arc_follower.h"

namespace gridshell::study {

/// How far and in which steps a branch is followed.
struct TraceOptions {
  ArcOptions arc;
  double from = 0, to = 1;      ///< range of the path parameter: the branch ends at either
  double max_strain = 1e-3;     ///< the branch ends above this strain
  int most_steps = 300;         ///< the branch ends after so many steps
  double located = 1e-3;        ///< fraction of a step to which a bifurcation is bisected
  int after_turn = most_steps;  ///< the branch ends so many steps after its first limit point
};

/// One equilibrium of a traced branch.
struct TracedPoint {
  PathPoint at;
  int negative_pivots = 0;
  record::BranchEvent event = record::BranchEvent::none;
  int pivots_after = 0;  ///< negative pivots just after a bifurcation
};

/// Whether the branch has met another one at this bifurcation, and ends.
using MeetsBranch = std::function<bool(const TracedPoint&)>;

/// Follows a branch from the current point of `path`, which is included, until it leaves the range,
/// meets another one or its own beginning, reaches the strain limit, is lost, or has taken the
/// largest number of steps. Bifurcations are located by bisection, limit points by smaller steps;
/// both are among the points. If it is cancelled, the last point has no event.
std::vector<TracedPoint> trace(Linearisation& system, const PinnedMotion& motion, ArcFollower path,
                               const TraceOptions& options, const MeetsBranch& met,
                               const Watch& watch);

/// Start vectors of a subspace iteration (`count` columns), fixed and irregular, so that they have
/// a component along every mode.
Eigen::MatrixXd generic_vectors(Eigen::Index rows, Eigen::Index count);

/// The modes whose stiffness changes its sign at a bifurcation: one 3 x columns array of norm 1
/// each, by inverse subspace iteration [Bathe 1996].
std::vector<Eigen::Matrix3Xd> crossing_modes(Linearisation& system, const PinnedMotion& motion,
                                             const TracedPoint& crossing, const Watch& watch);

struct BranchesOptions {
  int most_branches = 13;  ///< including the path itself
  int most_steps = 1000;   ///< largest number of arc steps of a branch
};

/// The bifurcation diagram of a preset on one mesh: its path by arc length, and the branches from
/// the points at which it loses or regains stability.
struct BranchDiagram {
  std::vector<record::BranchPoint> points;
  int edges_per_segment = 0;
  /// of the path's symmetry, 1 to 8; the amplitude of a point is that of the part which breaks it
  int symmetry_order = 0;
  double original_radius_mm = record::unknown;  ///< R_o of a circular boundary
  bool of_push = false;                         ///< progress is that of the push
  /// false: more branches were found than followed, or one was not followed to its end
  bool all_followed = true;
};

/// Follows the actuation or, if there is one, the push after it, on the finest initial mesh of the
/// tolerance. An actuation is followed from the first buckled state towards the flat and to the
/// end, or from the net backwards. At every bifurcation the branches along the modes that lost
/// stability are followed on both sides [Keller 1977], each once. `imperfection` has no effect.
/// Errors: bad_input for the net model, for a path without a start or an actuation that ends before
/// the push; no_equilibrium; cancelled.
Result<BranchDiagram> branches_study(const preset::Preset& preset, const BranchesOptions& options,
                                     Watch& watch);

}  // namespace gridshell::study
