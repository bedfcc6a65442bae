// The points of a sweep: figures of one run or search for states, computed on several threads.
#pragma once

#include <functional>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/preset/sweep_grid.h"
#include "engine/record/sweep_results.h"

namespace gridshell::study {

/// The figures (named numbers) of a preset's run, of its last state: those of summary.json except
/// times; progress, below 1 if the path ended early; depth_mm and force_N of a push;
/// stiffness_ratio = EA d^2/EI of the rods; the longest and shortest leg of a circle
/// (phase_diagram.h). A preset that searches for states has those of the state of lowest energy,
/// then those of the search (phase_diagram.h). `[movie]` and `[figure]` do not change figures.
/// Errors: bad_input, no_equilibrium, cancelled.
Result<record::Figures> figures_of(const preset::Preset& preset, Watch& watch);

/// The names of all figures that figures_of() can give for runs, or for searches for states.
std::vector<std::string> figure_names(bool search);

/// Hash of what the numbers of a sweep depend on: the printed preset without its texts and the keys
/// of pictures and plots.
std::uint64_t config_of(const preset::Presets& presets);

/// Indices of the points that one of `shards` shards computes: every shards-th point, so that
/// expensive ones are distributed. `shard` counts from 1.
std::vector<std::size_t> points_of_shard(std::size_t points, int shard, int shards);

/// Computes points, `jobs` at a time, and passes each to `finished` when it is computed, never two
/// at once. The order depends on the machine, the results do not. An error of a point is its
/// result; io and cancelled, and any error of `finished`, end the work. Errors: these; points that
/// are being computed are then lost.
Result<void> run_points(const preset::SweepGrid& grid, const std::vector<std::size_t>& points,
                        int jobs, const std::function<Result<void>(record::PointResult)>& finished,
                        Watch& watch);

}  // namespace gridshell::study
