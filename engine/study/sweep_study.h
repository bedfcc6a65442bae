// What a sweep computes at a point.
#pragma once

#include <functional>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/preset/sweep_grid.h"
#include "engine/record/sweep_results.h"

namespace gridshell::study {

/// The figures of a preset's run: those of summary.json but for its seconds, for its last state;
/// how far that is (progress, below 1 where the path ended early), the depth and the force of a
/// push (depth_mm, force_N), and what its rods are: stiffness_ratio, EA d^2/EI; of a circle the
/// paper's longest and shortest leg (phase_diagram.h). Of a preset that looks for states: the
/// figures of the state of lowest energy, then those of the search (phase_diagram.h). `[movie]` and
/// `[figure]` change none of them. Errors: bad_input, no_equilibrium, cancelled.
Result<record::Figures> figures_of(const preset::Preset& preset, Watch& watch);

/// The names of all figures that figures_of() can give for runs, or for searches for states.
std::vector<std::string> figure_names(bool search);

// Computes points of a sweep on several threads.

/// Hash of what the numbers of a sweep depend on: the printed preset without its pictures, words
/// and plots.
std::uint64_t config_of(const preset::Presets& presets);

/// What the i-th of n shards computes: every n-th point, so that dear ones spread. `shard` counts
/// from 1.
std::vector<std::size_t> points_of_shard(std::size_t points, int shard, int shards);

/// Computes points, `jobs` at a time, and hands each to `finished` as soon as it is found, never
/// two at once; in which order depends on the machine, what is in them does not. An error of
/// `finished` ends the work, and so does one of a point that is not the point's own (io). Errors:
/// those, and cancelled: points in flight are then lost.
Result<void> run_points(const preset::SweepGrid& grid, const std::vector<std::size_t>& points,
                        int jobs, const std::function<Result<void>(record::PointResult)>& finished,
                        Watch& watch);

}  // namespace gridshell::study
