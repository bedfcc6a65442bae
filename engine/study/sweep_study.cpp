#include "engine/study/sweep_study.h"

#include <mutex>

#include "engine/core/parallel.h"
#include "engine/experiment/point.h"
#include "engine/preset/writer.h"
#include "engine/record/checksum.h"
#include "engine/study/stopwatch.h"

namespace gridshell::study {
namespace {

using record::PointOutcome;
using record::PointResult;

constexpr double no_limit_s = 1e9;

/// A point computed; an error where that is not the point's own.
Result<PointResult> result_of(const preset::SweepGrid& grid, std::size_t point, Watch& watch) {
  PointResult result;
  result.point = point;
  auto figures = experiment::figures_of(grid.at(point).preset, watch);
  if (figures) {
    result.figures = std::move(*figures);
    return result;
  }
  result.reason = figures.error().message;
  switch (figures.error().fault) {
    case Fault::bad_input:
      result.outcome = PointOutcome::refused;
      return result;
    case Fault::no_equilibrium:
      result.outcome = PointOutcome::no_equilibrium;
      return result;
    case Fault::io:
    case Fault::cancelled:
      break;
  }
  return tl::unexpected<Error>(figures.error());
}

}  // namespace

std::uint64_t config_of(const preset::Presets& presets) {
  preset::Presets computed = presets;
  const auto strip = [](preset::Preset& preset) {
    preset.title = preset.description = preset.source = "";
    preset.allow_unstable = false;
    preset.movie = {};
    preset.style = {};
    preset.figure = {};
    preset.page = {};
    preset.sweep.plot.clear();
    preset.sweep.x = "";
    preset.sweep.departure = 0;
  };
  strip(computed.base);
  for (auto& one : computed.cases) strip(one.preset);
  record::Checksum sum;
  sum.add(preset::to_toml(computed));
  return sum.value();
}

std::vector<std::size_t> points_of_shard(std::size_t points, int shard, int shards) {
  std::vector<std::size_t> mine;
  for (auto k = std::size_t(shard - 1); k < points; k += std::size_t(shards)) mine.push_back(k);
  return mine;
}

Result<void> run_points(const preset::SweepGrid& grid, const std::vector<std::size_t>& points,
                        int jobs, const std::function<Result<void>(PointResult)>& finished,
                        Watch& watch) {
  keep_blas_on_one_thread();
  std::mutex one_at_a_time;
  bool refused = false;
  const auto compute = [&](int k) -> Result<void> {
    // each point tells its own progress, and all hear the same wish to stop
    TimeLimit none(no_limit_s, watch);
    auto result = result_of(grid, points[std::size_t(k)], none.watch());
    if (!result) return tl::unexpected<Error>(result.error());
    const std::lock_guard lock(one_at_a_time);
    // nothing more is handed over once that failed
    if (refused) return stopped();
    auto kept = finished(std::move(*result));
    refused = !kept;
    return kept;
  };
  return share_work(int(points.size()), jobs, watch, compute,
                    [&](double share) { watch.report(share); });
}

}  // namespace gridshell::study
