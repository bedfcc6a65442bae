// What the charts of methods are made of: a line of accuracy.csv a point of speed against accuracy,
// a line of stability.csv a cell of a map. Millimetres, seconds.
#pragma once

#include <string>
#include <vector>

#include "engine/core/words.h"
#include "engine/record/snapshot.h"

namespace gridshell::record {

/// What a method's run came to, judged from outside. The last three are *silent*: the method
/// reported success.
enum class RunOutcome {
  right,          ///< reported success, and it is the state asked for
  refused,        ///< the method said that it cannot, or that what it found is not stable
  not_converged,  ///< ended without a rest, and said so
  blow_up,        ///< grew without bound, and said so
  too_slow,       ///< stopped at the time limit
  planar_saddle,  ///< rests in the boundary's plane, where the shell is not stable
  other_state,    ///< rests in another stable state than the one the path leads to
  silent_wrong,   ///< neither: off by more than ten times the tolerance, or with negative pivots
};

constexpr auto words(RunOutcome) {
  return word_table<RunOutcome>({{RunOutcome::right, "right"},
                                 {RunOutcome::refused, "refused"},
                                 {RunOutcome::not_converged, "not_converged"},
                                 {RunOutcome::blow_up, "blow_up"},
                                 {RunOutcome::too_slow, "too_slow"},
                                 {RunOutcome::planar_saddle, "planar_saddle"},
                                 {RunOutcome::other_state, "other_state"},
                                 {RunOutcome::silent_wrong, "silent_wrong"}});
}

/// Whether a user would have been told a wrong result.
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

/// How a method's time grows with the number of rods.
struct ScalingRow {
  std::string method;
  int rods = 0;  ///< a direction
  int edges_per_segment = 0, dof = 0;
  double cpu_s = unknown, cpu_min_s = unknown, cpu_max_s = unknown;
  RunOutcome outcome = RunOutcome::right;
};

/// One cell of a map.
struct StabilityRow {
  std::string map, method;
  std::string x_name;
  double x = 0;
  std::string y_name;
  double y = 0;
  RunOutcome outcome = RunOutcome::right;
};

/// The texts of accuracy.csv, scaling.csv and stability.csv; unknown numbers are empty.
std::string accuracy_csv(const std::vector<AccuracyRow>& rows);
std::string scaling_csv(const std::vector<ScalingRow>& rows);
std::string stability_csv(const std::vector<StabilityRow>& rows);

/// Slope of log(y) over log(x) by least squares; NaN for fewer than two positive points.
double exponent(const std::vector<double>& x, const std::vector<double>& y);

/// Indices of the points that no other is both faster and more accurate than, from the fastest to
/// the most accurate; only outcomes `right`. Errors within 5 % count as the same: methods on one
/// mesh differ by how far they came to rest.
std::vector<std::size_t> pareto_front(const std::vector<AccuracyRow>& rows);

}  // namespace gridshell::record
