// Comparison of methods: speed against accuracy, and where they succeed and fail.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/study_tables.h"

namespace gridshell::study {

class BenchmarkProblem;

// Speed against accuracy: every method on the meshes that it can afford.

struct AccuracyOptions {
  double seconds = 30;  ///< a run that takes longer is too slow
  int finest = 128;     ///< edges per segment of the reference's finest mesh
  int most_edges = 32;  ///< edges per segment of the methods' finest mesh
  int runs = 7;         ///< number of runs of a fast method; fewer if a run takes long
  int threads = 2;      ///< for the methods of others; the engine's own, which are fast, run alone
  bool scaling = true;  ///< also measure the time over the number of rods
};

/// The engine with a tolerance (`auto`) compared with the fastest of all other methods.
struct AutoOutcome {
  /// the requested tolerance and the error, over the length scale; processor time
  double tolerance = 0, error = 0, cpu_s = 0;
  double front_s = 0;      ///< processor time of the fastest other method with at most this error
  double tolerance_s = 0;  ///< processor time of the fastest other method that meets the tolerance
};

struct AccuracyStudy {
  std::vector<record::AccuracyRow> rows;
  std::vector<record::ScalingRow> scaling;
  std::vector<AutoOutcome> outcomes;
  double reference_error = 0;  ///< estimated, over the length scale
};

/// Tolerances at which `auto` is marked; its rows are called "auto 1e-02" and so on.
inline constexpr double auto_tolerances[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6};

/// Runs all methods on a preset. Errors: those of BenchmarkProblem::create; cancelled.
Result<AccuracyStudy> accuracy_study(const preset::Preset& preset, const AccuracyOptions& options,
                                     Watch& watch);

/// Errors and times of `auto` at several tolerances for each number of rods per direction in
/// `sizes`, on a circle with the preset's spacing, longest leg and ratio of radii. The method of a
/// row is for example "12 rods"; rows are in the order of `sizes`. Errors: bad_input for other
/// footprints; those of BenchmarkProblem::create; cancelled.
Result<std::vector<record::AccuracyRow>> sizes_study(const preset::Preset& preset,
                                                     const std::vector<int>& sizes,
                                                     const AccuracyOptions& options, Watch& watch);

// Maps that show where methods succeed and fail, one run per cell.

struct StabilityOptions {
  double seconds = 4;  ///< a run that takes longer is too slow
  int threads = 2;
};

/// Name of the engine's own solver in maps.
inline constexpr const char* default_solver = "default";

/// One cell of a map: its row of the table, and the run that computes its outcome.
struct Cell {
  record::StabilityRow row;
  std::function<record::RunOutcome(const Watch&)> run;
  /// Makes what several cells share, once, before the first of them runs; empty: nothing. Without
  /// it their outcome is `refused`.
  std::function<void(Watch&)> prepare = {};
};

/// The cells of a map: one variable along the columns, one along the rows, for several methods,
/// among them the default solver where it applies. Outcomes are judged by verdict_of().
using Cells = std::vector<Cell>;
using Axis = std::vector<double>;
using SharedProblem = std::shared_ptr<BenchmarkProblem>;

// In the names of the maps "a x b" has a along the columns and b along the rows; "edges" are those
// per segment of the mesh.

/// Explicit time step over l_min/c (c the speed of sound in the rods) x edges: whether the
/// equilibrium, perturbed by a hundredth of a millimetre, is maintained for 20 000 steps.
Cells explicit_map(const SharedProblem& study, const Axis& steps, const Axis& edges);
/// Step of kinetic dynamic relaxation over its limit x edges, over the complete path.
Cells relaxation_map(const SharedProblem& study, const Axis& steps, const Axis& edges);
/// Load steps x edges, for Newton's method with full steps, with a line search and shifted, and for
/// the default solver, which takes its own load steps between so many certified states.
Cells newton_map(const SharedProblem& study, const Axis& load_steps, const Axis& edges);
/// Tolerance of Newton's corrections (mm) x load steps. For the default solver it is the tolerance
/// of the joints, judged by the converged reference.
Cells tolerance_map(const SharedProblem& study, const Axis& tolerances, const Axis& load_steps,
                    int edges);
/// Axial stiffness EA over that of the rods x load steps; every EA has a reference of its own.
Cells stiffness_map(const preset::Preset& preset, const Axis& scales, const Axis& load_steps,
                    int edges);
/// Shortest leg over d x load steps of a circle; empty for other footprints.
Cells leg_map(const preset::Preset& preset, const Axis& legs, const Axis& load_steps, int edges);
/// Height of the seed (mm) on the flat footprint x edges, for one load step to the study's start (a
/// circle: R_a = 0.98 R_o).
Cells seed_map(const SharedProblem& study, const Axis& heights, const Axis& edges);
/// Stiffness of spring joints (N/mm) x load steps, for Newton's method with full steps and shifted,
/// on the twist model; judged by a run with the same joints in 60 load steps.
Cells joint_map(const SharedProblem& study, const Axis& stiffnesses, const Axis& load_steps,
                int edges);

/// Runs cells on several threads and stores their outcomes in them.
Result<void> run_cells(Cells& cells, const StabilityOptions& options, Watch& watch);

/// All maps of a preset. Errors: those of BenchmarkProblem::create; bad_input if the preset has a
/// push or starts on a net; cancelled.
Result<std::vector<record::StabilityRow>> stability_study(const preset::Preset& preset,
                                                          const StabilityOptions& options,
                                                          Watch& watch);

}  // namespace gridshell::study
