#include "engine/study/sweep_study.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

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

/// The threads of a sweep, the one that asked among them.
class Workers {
 public:
  Workers(const preset::SweepGrid& grid, const std::vector<std::size_t>& points,
          const std::function<Result<void>(PointResult)>& finished, Watch& watch)
      : grid_(grid), points_(points), finished_(finished), watch_(watch) {}

  Result<void> run(int jobs) {
    std::vector<std::thread> helpers;
    for (int k = 1; k < jobs && std::size_t(k) < points_.size(); ++k)
      helpers.emplace_back([this] { work(); });
    work();
    for (std::thread& helper : helpers) helper.join();
    if (thrown_) std::rethrow_exception(thrown_);
    if (error_) return tl::unexpected<Error>(*error_);
    if (watch_.cancelled()) return fail(Fault::cancelled, "stopped");
    return {};
  }

 private:
  void work() {
    while (!stop_) {
      const std::size_t k = next_++;
      if (k >= points_.size() || watch_.cancelled()) return;
      try {
        // each point tells its own progress, and all hear the same wish to stop
        TimeLimit none(no_limit_s, watch_);
        take(result_of(grid_, points_[k], none.watch()));
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!thrown_) thrown_ = std::current_exception();
        stop();
      }
    }
  }

  /// What else is in flight is lost.
  void stop() {
    stop_ = true;
    watch_.cancel();
  }

  void take(Result<PointResult> result) {
    const std::lock_guard lock(mutex_);
    if (stop_) return;
    Result<void> kept;
    if (result)
      kept = finished_(std::move(*result));
    else
      kept = tl::unexpected<Error>(result.error());
    if (!kept) {
      error_ = kept.error();
      stop();
    }
    watch_.report(double(++done_) / double(points_.size()));
  }

  const preset::SweepGrid& grid_;
  const std::vector<std::size_t>& points_;
  const std::function<Result<void>(PointResult)>& finished_;
  Watch& watch_;
  std::mutex mutex_;
  std::atomic<std::size_t> next_{0};
  std::size_t done_ = 0;
  std::atomic<bool> stop_{false};
  std::optional<Error> error_;
  std::exception_ptr thrown_;
};

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
  return Workers(grid, points, finished, watch).run(jobs);
}

}  // namespace gridshell::study
