// What the charts of methods are made of: a line of accuracy.csv a point of speed against accuracy,
// a line of stability.csv a cell of a map. Millimetres, seconds.
#pragma once

#include <string>
#include <vector>

#include "engine/core/enum_words.h"
#include "engine/core/fields.h"
#include "engine/record/frame.h"

namespace gridshell::record {

/// Outcome of a method's run, judged by a reference. The last three are *silent*: the method
/// reported success.
enum class RunOutcome {
  right,          ///< reported success, and the state is the requested one
  refused,        ///< the method said that it cannot, or that what it found is not stable
  not_converged,  ///< ended without an equilibrium and reported it
  blow_up,        ///< grew without bound, and said so
  too_slow,       ///< stopped at the time limit
  planar_saddle,  ///< equilibrium in the boundary's plane, where the shell is unstable
  other_state,    ///< another stable equilibrium than the one the path leads to
  silent_wrong,   ///< neither: off by more than ten times the tolerance, or with negative pivots
};

/// Whether a user would have received a wrong result without a message.
bool silently_wrong(RunOutcome outcome);

/// One method on one mesh.
struct AccuracyRow {
  std::string method;
  int edges_per_segment = 0;  ///< of the finest mesh; 0 for the net
  int dof = 0;
  double error = unknown;  ///< largest joint error over R_o or rho
  double cpu_s = unknown;  ///< median
  double cpu_min_s = unknown, cpu_max_s = unknown;
  RunOutcome outcome = RunOutcome::right;
};
template <RecordOf<AccuracyRow> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit_each(visit, "method", row.method, "edges_per_segment", row.edges_per_segment, "dof",
             row.dof, "error", row.error, "cpu_s", row.cpu_s, "cpu_min_s", row.cpu_min_s,
             "cpu_max_s", row.cpu_max_s, "outcome", row.outcome);
}

/// How a method's time grows with the number of rods.
struct ScalingRow {
  std::string method;
  int rods = 0;  ///< a direction
  int edges_per_segment = 0, dof = 0;
  double cpu_s = unknown, cpu_min_s = unknown, cpu_max_s = unknown;
  RunOutcome outcome = RunOutcome::right;
};
template <RecordOf<ScalingRow> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit_each(visit, "method", row.method, "rods", row.rods, "edges_per_segment",
             row.edges_per_segment, "dof", row.dof, "cpu_s", row.cpu_s, "cpu_min_s", row.cpu_min_s,
             "cpu_max_s", row.cpu_max_s, "outcome", row.outcome);
}

/// One cell of a map.
struct StabilityRow {
  std::string map, method;
  std::string x_name;
  double x = 0;
  std::string y_name;
  double y = 0;
  RunOutcome outcome = RunOutcome::right;
};
template <RecordOf<StabilityRow> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit_each(visit, "map", row.map, "method", row.method, "x_name", row.x_name, "x", row.x,
             "y_name", row.y_name, "y", row.y, "outcome", row.outcome);
}

/// Slope of log(y) over log(x) by least squares; NaN for fewer than four positive points.
double exponent(const std::vector<double>& x, const std::vector<double>& y);

/// Indices of the points that no other point exceeds both in speed and in accuracy, from the
/// fastest to the most accurate; only outcomes `right`. Errors within 5 % count as equal, since
/// methods on one mesh differ by their convergence.
std::vector<std::size_t> pareto_front(const std::vector<AccuracyRow>& rows);

// How a shell vibrates: a line of modes.csv a mode.

/// A natural vibration about an equilibrium, extrapolated over the last two meshes.
struct ModeRow {
  int mode = 0;  ///< from 1, in ascending order
  /// Below 0: no vibration, the state is not stable and leaves as exp(2 pi |f| t).
  double frequency_Hz = unknown;
  double error_Hz = unknown;  ///< NaN on one mesh
  double residual = unknown;  ///< |K v - lambda M v| / |lambda M v| on the finest mesh
};
template <RecordOf<ModeRow> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit_each(visit, "mode", row.mode, "frequency_Hz", row.frequency_Hz, "error_Hz", row.error_Hz,
             "residual", row.residual);
}

// A bifurcation diagram: the points of a path and of the branches that leave it.

/// What happens at a point of a branch.
enum class BranchEvent {
  none,
  bifurcation,  ///< stability changes and the path continues: branches cross
  turn,         ///< a limit point (fold)
  joins,        ///< the branch meets one that was followed before
  locking,      ///< the rods are at their length: it ends there
  lost,         ///< it could not be followed further
};
constexpr auto words(BranchEvent) { return names_except<BranchEvent>({{BranchEvent::none, ""}}); }

/// One equilibrium of a branch; points of a branch are in the order of its arc length.
struct BranchPoint {
  int branch = 0;       ///< 0: the path itself
  double progress = 0;  ///< of the actuation, or of the push
  double boundary_radius_mm = unknown;
  double height_mm = 0;        ///< highest joint above the boundary's plane
  double amplitude = unknown;  ///< root mean square of what breaks the symmetry of the path, over
                               ///< the length scale, signed
  double energy_mJ = 0;
  int negative_pivots = 0;
  BranchEvent event = BranchEvent::none;

  bool stable() const { return negative_pivots == 0; }
};
template <RecordOf<BranchPoint> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit_each(visit, "branch", row.branch, "progress", row.progress, "boundary_radius_mm",
             row.boundary_radius_mm, "height_mm", row.height_mm, "amplitude", row.amplitude,
             "energy_mJ", row.energy_mJ, "negative_pivots", row.negative_pivots, "event",
             row.event);
}

// Load study of a shell: load.csv has a row per point of a case's path, cases.csv a row per case.

/// A state under a multiple of the case's loads.
struct LoadPoint {
  std::string load_case;
  double factor = 0;
  double way_mm = 0;  ///< largest displacement of a joint, along its direction
  int negative_pivots = 0;
  BranchEvent event = BranchEvent::none;
  double utilisation = unknown;  ///< largest stress over the rods' strength
};
template <RecordOf<LoadPoint> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit_each(visit, "case", row.load_case, "factor", row.factor, "way_mm", row.way_mm,
             "negative_pivots", row.negative_pivots, "event", row.event, "utilisation",
             row.utilisation);
}

/// What became of a case.
struct LoadRow {
  std::string load_case;
  double critical_factor = unknown;  ///< NaN: stability is not lost on the path
  /// NaN on one mesh, or if the other has no loss of stability
  double error = unknown;
  BranchEvent event = BranchEvent::none;  ///< turn (a limit point), bifurcation, or why it ended
  double linear_factor = unknown;         ///< K_0 + factor K_g singular; NaN: never
  double linear_error = unknown;          ///< NaN on one mesh
  /// load factor at which a fibre reaches its rod's strength; NaN: none
  double strength_factor = unknown;
  double strength_error = unknown;
  double load_x_N = 0, load_y_N = 0, load_z_N = 0;  ///< sum of the loads at a factor of 1
  int imperfections = 0;  ///< shells that were not perfect and lost their stability too
  /// quantiles of their critical factors over the perfect shell's
  double knock_down_5 = unknown, knock_down_50 = unknown, knock_down_95 = unknown;
};
template <RecordOf<LoadRow> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit_each(visit, "case", row.load_case, "critical_factor", row.critical_factor, "error",
             row.error, "event", row.event, "linear_factor", row.linear_factor, "linear_error",
             row.linear_error, "strength_factor", row.strength_factor, "strength_error",
             row.strength_error, "load_x_N", row.load_x_N, "load_y_N", row.load_y_N, "load_z_N",
             row.load_z_N, "imperfections", row.imperfections, "knock_down_5", row.knock_down_5,
             "knock_down_50", row.knock_down_50, "knock_down_95", row.knock_down_95);
}

}  // namespace gridshell::record
