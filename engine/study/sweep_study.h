// Computes points of a sweep on several threads.
#pragma once

#include <functional>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/sweep_grid.h"
#include "engine/record/sweep.h"

namespace gridshell::study {

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
