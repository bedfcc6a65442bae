// Speed against accuracy: every method on the meshes that it can afford.
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/study_tables.h"

namespace gridshell::study {

struct AccuracyOptions {
  double seconds = 30;  ///< a method's run beyond that is too slow
  int finest = 128;     ///< edges a segment of the reference's finest mesh
  int most_edges = 32;  ///< of the methods
  int runs = 7;         ///< of fast methods; fewer where a run takes long
  int threads = 2;      ///< of the slow methods; the fast ones run alone
  bool scaling = true;  ///< also time over the number of rods
};

/// How `auto` stands beside the front of all methods.
struct AutoStanding {
  double tolerance = 0, error = 0, cpu_s = 0;
  double front_s = 0;  ///< the fastest of all methods that is at least as accurate as it was
  double asked_s = 0;  ///< the fastest of all methods that meets the tolerance
};

struct AccuracyStudy {
  std::vector<record::AccuracyRow> rows;
  std::vector<record::ScalingRow> scaling;
  std::vector<AutoStanding> standings;
  double reference_error = 0;  ///< estimated, over the length scale
};

/// Tolerances at which `auto` is marked; its rows are called "auto 1e-02" and so on.
inline constexpr double auto_tolerances[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6};

/// Errors: those of BenchmarkProblem::create.
Result<AccuracyStudy> accuracy_study(const preset::Preset& preset, const AccuracyOptions& options,
                                     Watch& watch);

/// `auto` at several tolerances on a circle of so many rods a direction, its spacing, longest leg
/// and share of actuation kept: rows of the method "12 rods", in order of the sizes. Errors:
/// bad_input for other footprints; those of BenchmarkProblem::create.
Result<std::vector<record::AccuracyRow>> sizes_study(const preset::Preset& preset,
                                                     const std::vector<int>& sizes,
                                                     const AccuracyOptions& options, Watch& watch);

}  // namespace gridshell::study
