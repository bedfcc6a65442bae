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
  int after_turn = most_steps;  ///< beyond its first limit point
};

/// One equilibrium on the way.
struct TracedPoint {
  PathPoint at;
  int negative_pivots = 0;
  record::BranchEvent event = record::BranchEvent::none;
  int beyond = 0;  ///< of a bifurcation: negative pivots just after it
};

/// Says of a point where something happens whether the branch ends there: it met another one.
using MeetsBranch = std::function<bool(const TracedPoint&)>;

/// Follows a branch from where `path` stands, the point itself included, until it leaves the range,
/// meets another one, comes to the rods' length or is lost. Bifurcations are located by bisection,
/// limit points by smaller steps; both stand among the points. The last point of a branch that was
/// cancelled is like any other.
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

/// Follows the actuation (from the first buckled state towards the flat and on to the end, or from
/// the net backwards), or the push after it, on the finest mesh that the tolerance begins with. At
/// every bifurcation the branches along the modes that went soft are entered on both sides
/// [Keller 1977], each once: `imperfection` chooses nothing here. Errors: bad_input for a preset of
/// which nothing is solved, whose path has no begin or whose actuation ends before the push;
/// no_equilibrium; cancelled.
Result<BranchDiagram> branches_study(const preset::Preset& preset, const BranchesOptions& options,
                                     Watch& watch);

}  // namespace gridshell::study
