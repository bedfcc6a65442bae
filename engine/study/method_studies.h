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
  double seconds = 30;  ///< a method's longer run is too slow
  int finest = 128;     ///< edges per segment of the reference's finest mesh
  int most_edges = 32;  ///< of the methods
  int runs = 7;         ///< of fast methods; fewer where a run takes long
  int threads = 2;      ///< of the slow methods; the fast ones run alone
  bool scaling = true;  ///< also time over the number of rods
};

/// Position of `auto` relative to the front of all methods.
struct AutoOutcome {
  double tolerance = 0, error = 0, cpu_s = 0;
  double front_s = 0;  ///< the fastest of all methods that is at least as accurate as it was
  double asked_s = 0;  ///< the fastest of all methods that meets the tolerance
};

struct AccuracyStudy {
  std::vector<record::AccuracyRow> rows;
  std::vector<record::ScalingRow> scaling;
  std::vector<AutoOutcome> standings;
  double reference_error = 0;  ///< estimated, over the length scale
};

/// Tolerances at which `auto` is marked; its rows are called "auto 1e-02" and so on.
inline constexpr double auto_tolerances[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6};

/// Errors: those of BenchmarkProblem::create.
Result<AccuracyStudy> accuracy_study(const preset::Preset& preset, const AccuracyOptions& options,
                                     Watch& watch);

/// `auto` at several tolerances on a circle with a number of rods per direction, with equal
/// spacing, longest leg and fraction of actuation: rows of the method "12 rods", in order of the
/// sizes. Errors: bad_input for other footprints; those of BenchmarkProblem::create.
Result<std::vector<record::AccuracyRow>> sizes_study(const preset::Preset& preset,
                                                     const std::vector<int>& sizes,
                                                     const AccuracyOptions& options, Watch& watch);

// Where methods succeed and fail: maps of outcomes, one run per cell.

struct StabilityOptions {
  double seconds = 4;  ///< a cell's longer run is too slow
  int threads = 2;
};

/// The engine's own solver, as maps call it.
inline constexpr const char* default_solver = "default";

/// One cell: what it is, and the run that fills in its outcome.
struct Cell {
  record::StabilityRow row;
  std::function<record::RunOutcome(const Watch&)> run;
};

/// A map over one variable of its columns and one of its rows, for several methods. Every map also
/// includes the default solver, where it applies. Outcomes are judged by a reference (verdict_of):
/// by the equilibrium of the same mesh on the branch of a reference that was followed on finer
/// meshes and extrapolated.
using Cells = std::vector<Cell>;
using Axis = std::vector<double>;
using SharedProblem = std::shared_ptr<BenchmarkProblem>;

/// Explicit time step over l_min/c (c the speed of sound in the rods) x edges per segment: whether
/// the equilibrium, perturbed by a hundredth of a millimetre, is maintained for 20 000 steps.
Cells explicit_map(const SharedProblem& study, const Axis& steps, const Axis& edges);
/// Step of kinetic dynamic relaxation over its limit x edges, over the whole path.
Cells relaxation_map(const SharedProblem& study, const Axis& steps, const Axis& edges);
/// Load steps x edges for Newton's method with full steps, with a line search, shifted, and by
/// default (then for the requested states: it takes its own load steps between them).
Cells newton_map(const SharedProblem& study, const Axis& load_steps, const Axis& edges);
/// Tolerance of Newton's corrections (mm) x load steps; by default that of the joints, which is
/// judged against the converged reference.
Cells tolerance_map(const SharedProblem& study, const Axis& tolerances, const Axis& load_steps,
                    int edges);
/// EA over that of the rods x load steps; every EA has a reference of its own.
Cells stiffness_map(const preset::Preset& preset, const Axis& scales, const Axis& load_steps,
                    int edges);
/// Shortest leg over d x load steps, of circles (none for other footprints).
Cells leg_map(const preset::Preset& preset, const Axis& legs, const Axis& load_steps, int edges);
/// Height of the seed (mm) on the flat footprint x edges, to 0.98 R_o at once.
Cells seed_map(const SharedProblem& study, const Axis& heights, const Axis& edges);
/// Stiffness of spring joints (N/mm) x load steps, with the twist model, shifted or with full
/// steps; judged by the same joints in 60 load steps.
Cells joint_map(const SharedProblem& study, const Axis& stiffnesses, const Axis& load_steps,
                int edges);

/// Runs cells on several threads and stores their outcomes in them.
Result<void> run_cells(Cells& cells, const StabilityOptions& options, Watch& watch);

/// All maps of a preset. Errors: those of BenchmarkProblem::create; bad_input where nothing is
/// actuated.
Result<std::vector<record::StabilityRow>> stability_study(const preset::Preset& preset,
                                                          const StabilityOptions& options,
                                                          Watch& watch);

}  // namespace gridshell::study
