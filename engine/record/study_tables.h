// Rows of the tables of studies: speed against accuracy (accuracy.csv), scaling, maps of where
// methods fail (stability.csv), modes, bifurcation diagrams, load cases. Millimetres, seconds.
#pragma once

#include <string>
#include <vector>

#include "engine/core/enum_words.h"
#include "engine/core/fields.h"
#include "engine/record/frame.h"

namespace gridshell::record {

/// Outcome of a method's run, judged by a reference. The last three are *silent*: the method
/// reported success although its result is wrong.
enum class RunOutcome {
  right,    ///< the method reported success, and the state is the requested one
  refused,  ///< the method reported that it cannot solve this, or that the state is not stable
  not_converged,  ///< it reported that it found no equilibrium
  blow_up,        ///< it grew without bound and reported it
  too_slow,       ///< it was stopped at the time limit
  planar_saddle,  ///< equilibrium in the boundary's plane, where the shell is unstable
  other_state,    ///< another stable equilibrium than the one the path leads to
  silent_wrong,   ///< neither: off by more than ten times the tolerance, or with negative pivots
};

/// Whether a user would have received a wrong result without a message.
bool silently_wrong(RunOutcome outcome);

/// One method on one mesh: a row of accuracy.csv.
struct AccuracyRow {
  std::string method;
  int edges_per_segment = 0;  ///< on the finest mesh; 0 for the net
  int dof = 0;
  double error = unknown;                           ///< largest joint error over R_o or rho
  double cpu_s = unknown;                           ///< median processor time
  double cpu_min_s = unknown, cpu_max_s = unknown;  ///< least and largest processor time
  RunOutcome outcome = RunOutcome::right;
  GRIDSHELL_FIELDS(method, edges_per_segment, dof, error, cpu_s, cpu_min_s, cpu_max_s, outcome)
};

/// The time of a method for a number of rods.
struct ScalingRow {
  std::string method;
  int rods = 0;  ///< rods per direction
  int edges_per_segment = 0, dof = 0;
  double cpu_s = unknown, cpu_min_s = unknown, cpu_max_s = unknown;
  RunOutcome outcome = RunOutcome::right;
  GRIDSHELL_FIELDS(method, rods, edges_per_segment, dof, cpu_s, cpu_min_s, cpu_max_s, outcome)
};

/// One cell of a map: a row of stability.csv.
struct StabilityRow {
  std::string map, method;
  std::string x_name;
  double x = 0;
  std::string y_name;
  double y = 0;
  RunOutcome outcome = RunOutcome::right;
  GRIDSHELL_FIELDS(map, method, x_name, x, y_name, y, outcome)
};

/// Slope of log(y) over log(x) by least squares; NaN for fewer than four positive points.
double exponent(const std::vector<double>& x, const std::vector<double>& y);

/// Indices of the rows of outcome `right` that no other row exceeds both in speed and in accuracy,
/// from the fastest to the most accurate. Errors within 5 % count as equal, since methods on the
/// same mesh differ by their convergence.
std::vector<std::size_t> pareto_front(const std::vector<AccuracyRow>& rows);

/// A natural vibration about an equilibrium, extrapolated over the last two meshes: a row of
/// modes.csv.
struct ModeRow {
  int mode = 0;  ///< number from 1, in ascending order of frequency
  /// Below 0: no vibration; the state is unstable, and disturbances grow as exp(2 pi |f| t).
  double frequency_Hz = unknown;
  double error_Hz = unknown;  ///< NaN on one mesh
  double residual = unknown;  ///< |K v - lambda M v| / |lambda M v| on the finest mesh
  GRIDSHELL_FIELDS(mode, frequency_Hz, error_Hz, residual)
};

// A bifurcation diagram: the points of a path and of the branches that bifurcate from it.

/// Event at a point of a branch.
enum class BranchEvent {
  none,
  bifurcation,  ///< stability changes and the path continues: branches cross
  turn,         ///< a limit point (fold)
  joins,        ///< the branch meets one that was followed before, or its own beginning
  locking,      ///< the rods reach the strain limit: the branch ends
  lost,         ///< the branch could not be followed further
  unfinished,   ///< the branch continues, but was followed for the largest number of steps
};
constexpr auto words(BranchEvent) { return names_except<BranchEvent>({{BranchEvent::none, ""}}); }

/// One equilibrium of a branch; points of a branch are in the order of its arc length.
struct BranchPoint {
  int branch = 0;       ///< 0: the path itself
  double progress = 0;  ///< progress of the actuation, or of the push
  double boundary_radius_mm = unknown;
  double height_mm = 0;        ///< height of the highest joint above the boundary's plane
  double amplitude = unknown;  ///< signed root mean square of the part of the shape that breaks the
                               ///< symmetry of the path, over the length scale
  double energy_mJ = 0;
  int negative_pivots = 0;
  BranchEvent event = BranchEvent::none;

  bool stable() const { return negative_pivots == 0; }
  GRIDSHELL_FIELDS(branch, progress, boundary_radius_mm, height_mm, amplitude, energy_mJ,
                   negative_pivots, event)
};

// Load study of a shell: load.csv has a row per point of a case's path, cases.csv a row per case.

/// A state under a multiple of a case's loads: a row of load.csv.
struct LoadPoint {
  std::string load_case;
  double factor = 0;
  /// displacement of the joint that moves most at the loss of stability, along its direction
  double way_mm = 0;
  int negative_pivots = 0;
  BranchEvent event = BranchEvent::none;
  double utilisation = unknown;  ///< largest stress over the rods' strength
};
template <RecordOf<LoadPoint> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit("case", row.load_case);
  GRIDSHELL_VISIT(visit, row.factor, row.way_mm, row.negative_pivots, row.event, row.utilisation);
}

/// Result of a load case: a row of cases.csv.
struct LoadRow {
  std::string load_case;
  /// load factor at which stability is lost; NaN: it is not lost on the path
  double critical_factor = unknown;
  /// its error; NaN on one mesh, or if stability is lost on one of two meshes only
  double error = unknown;
  BranchEvent event = BranchEvent::none;  ///< turn (a limit point), bifurcation, or why it ended
  /// factor of linear buckling, at which K_0 + factor K_g is singular; NaN: none
  double linear_factor = unknown;
  double linear_error = unknown;  ///< error of linear_factor; NaN on one mesh
  /// load factor at which a fibre reaches its rod's strength; NaN: none
  double strength_factor = unknown;
  double strength_error = unknown;
  double load_x_N = 0, load_y_N = 0, load_z_N = 0;  ///< sum of the loads at a factor of 1
  int imperfections = 0;                            ///< number of imperfect shells
  int imperfections_failed = 0;  ///< those without an equilibrium or a path under the case
  /// quantiles (5, 50, 95 %) of their critical factors (0 if failed) over that of the perfect shell
  double knock_down_5 = unknown, knock_down_50 = unknown, knock_down_95 = unknown;
};
/// How the shell loses its stability: "limit point", "bifurcation", or that it does not.
std::string loss_text(const LoadRow& row);
/// "median of 20 imperfect shells: 0.84 of that factor (5 to 95 %: 0.71 to 0.93)"; empty: none.
std::string knock_down_text(const LoadRow& row);

template <RecordOf<LoadRow> Row, class Visit>
void fields(Row& row, const Visit& visit) {
  visit("case", row.load_case);
  GRIDSHELL_VISIT(visit, row.critical_factor, row.error, row.event, row.linear_factor,
                  row.linear_error, row.strength_factor, row.strength_error, row.load_x_N,
                  row.load_y_N, row.load_z_N, row.imperfections, row.imperfections_failed,
                  row.knock_down_5, row.knock_down_50, row.knock_down_95);
}

}  // namespace gridshell::record
