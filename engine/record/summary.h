// Results of a run, written to summary.json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/enum_words.h"
#include "engine/core/fields.h"
#include "engine/core/result.h"
#include "engine/core/system_info.h"
#include "engine/record/sweep_results.h"
#include "engine/record/trajectory.h"

namespace gridshell::record {

/// How a run ended.
enum class Limit { none, locking, snap, branch_lost, no_equilibrium, strength, contact };

/// The command that made a folder, which decides what its frames sample: a movie, or the stills of
/// a figure.
enum class Kind { unknown, run, figure, movie };

/// Names of Kind; version 0.1 did not write it.
constexpr auto words(Kind) { return names_except<Kind>({{Kind::unknown, ""}}); }

/// Results of a run, for its last frame unless stated otherwise.
struct Summary : StateFigures {
  std::string program = std::string("gridshell ") + version();  ///< program that computed the run
  std::string preset;
  std::string model;         ///< "net", "bend" or "twist"
  std::string model_reason;  ///< one sentence: why this rod model is exact
  int edges_per_segment = 0;
  int rods = 0, joints = 0, cells = 0, dof = 0;
  bool solved = true;  ///< false: the net itself, without an equilibrium; stability is then null
  bool stable = false;
  Limit limit = Limit::none;
  /// events that the path passed, as sentences; never empty with a limit
  std::string limit_reason;
  std::string doubt;  ///< sentences on what is not confirmed; empty: all is confirmed
  /// Whether the estimated error of every load step is within the requested tolerance; if not,
  /// `doubt` has the error.
  bool tolerance_met = true;
  double largest_strain = unknown;  ///< axial strain of the edge with the largest |strain|
  std::string pushed_joint;         ///< joint that [indentation] pushes: "[0, -1]"; empty: none
  std::string contact;  ///< parts that came into contact, and at which progress; empty: none
  double max_deviation = unknown,
         mean_deviation = unknown;     ///< deviations of the joints from the net, over rho
  double median_deviation = unknown;   ///< median of these deviations
  double deviation_p90 = unknown;      ///< their 90 % quantile
  double max_seam_gap_mm = unknown;    ///< largest distance of building blocks at a seam
  double max_seam_kink_deg = unknown;  ///< largest angle of a rod's tangents at a seam
  int newton_iterations = 0, factorizations = 0;  ///< sums over the complete run
  double seconds_setup = 0, seconds_simulation = 0, seconds_render = 0;
  std::vector<std::string> steps;  ///< result of each [[step]], a sentence
  Kind kind = Kind::unknown;
  /// false: the run was interrupted, and the folder has the frames computed so far
  bool finished = true;

  /// Copies the quantities of the last frame.
  void take_state(const Frame& last);
  /// "BREAKS: 2.08 times the strength"; empty if no fibre exceeds its rod's strength.
  std::string breaking() const;
};
template <RecordOf<Summary> Run, class Visit>
void fields(Run& run, const Visit& visit) {
  GRIDSHELL_VISIT(visit, run.program, run.preset, run.model, run.model_reason,
                  run.edges_per_segment, run.rods, run.joints, run.cells, run.dof, run.stable,
                  run.negative_pivots, run.limit, run.limit_reason, run.doubt, run.tolerance_met,
                  run.residual_N, run.largest_strain, run.error_estimate_mm, run.force_N,
                  run.push_error_N, run.stiffness_N_per_mm, run.stiffness_error_N_per_mm,
                  run.largest_force_N, run.force_error_N);
  visit("energies_error_mJ", run.energy_error_mJ);
  GRIDSHELL_VISIT(visit, run.largest_bending_strain, run.bending_strain_at, run.largest_stress_MPa,
                  run.utilisation, run.stress_at, run.pushed_joint);
  visit_energies(run.energies, visit);
  // not stored: written, and dropped when read back
  double energy_mJ = run.energies.total();
  GRIDSHELL_VISIT(visit, energy_mJ, run.height_mm, run.lowest_mm, run.contacts, run.rod_gap_mm,
                  run.joint_gap_mm, run.contact, run.total_K, run.max_deviation, run.mean_deviation,
                  run.median_deviation, run.deviation_p90, run.max_seam_gap_mm,
                  run.max_seam_kink_deg, run.newton_iterations, run.factorizations,
                  run.seconds_setup, run.seconds_simulation, run.seconds_render, run.steps,
                  run.kind, run.finished);
}

// summary.json: the figures of a run as one JSON object, keys as in Summary, in its order.

/// The text of summary.json. What is unknown (NaN) is null; numbers read back bit for bit.
std::string to_json(const Summary& summary);

/// The summary as results of a point of a sweep, without what differs between repetitions
/// (seconds), what is equal for all points (program, preset, model_reason, kind, finished), and
/// texts on positions and steps.
Figures figures_of(const Summary& summary);

/// Writes summary.json completely or not at all. Errors: Fault::io with path and reason.
Result<void> write_summary(const std::filesystem::path& path, const Summary& summary);

/// Reads a file of write_summary; unknown keys are ignored. Errors: Fault::io if the file cannot be
/// read; Fault::bad_input with the path and the key that is missing or wrong.
Result<Summary> read_summary(const std::filesystem::path& path);

}  // namespace gridshell::record
