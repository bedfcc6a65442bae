#include "engine/study/sweep_study.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "engine/core/file_io.h"
#include "engine/core/parallel.h"
#include "engine/core/team.h"
#include "engine/core/try.h"
#include "engine/preset/preset_file.h"
#include "engine/record/phase_diagram.h"
#include "engine/record/summary.h"
#include "engine/simulate/run.h"
#include "engine/study/state_library.h"

namespace gridshell::study {

using namespace simulate;

namespace {

constexpr int samples = 41;  // of a path from the flat

/// Keeps the last frame alone.
class LastFrameSink final : public record::Sink {
 public:
  Result<void> begin(record::Layout) override {
    last_ = {};
    return {};
  }
  Result<void> take(record::Frame frame) override {
    if (frame.index >= last_.index) last_ = record::without_nodes(frame);
    return {};
  }
  const record::Frame& last() const { return last_; }

 private:
  record::Frame last_;
};

record::Figure known(double value) {
  if (std::isfinite(value)) return value;
  return {};
}

/// Results of a run in addition to its summary.
record::Figures more_of(const Scene* scene, const record::Frame& last) {
  record::Figure ratio;
  if (scene) {
    const RodMaterial& rod = scene->rods.materials.front();
    const double d = scene->footprint.spacing;
    ratio = rod.EA * d * d / std::min(rod.EI1, rod.EI2);
  }
  return {{"progress", known(last.progress)},
          {"depth_mm", known(last.depth_mm)},
          {"stiffness_ratio", ratio}};
}

/// The legs of a circle; the names without values if there is no preset or no circle.
record::Figures legs_of(const preset::Preset* preset) {
  record::Figures legs{{record::longest_leg_name, {}}, {record::corner_leg_name, {}}};
  if (!preset || preset->footprint.kind != preset::FootprintKind::circle) return legs;
  const double radius = preset->original_radius_mm() / preset->footprint.spacing_mm;
  legs[0].second = record::longest_leg(radius, preset->footprint.rods);
  legs[1].second = record::shortest_leg(radius, preset->footprint.rods);
  return legs;
}

void append(record::Figures& figures, record::Figures more) {
  for (auto& one : more) figures.push_back(std::move(one));
}

/// A point that searches for states. Each state is identified, but its range is not computed.
Result<record::Figures> figures_of_search(const preset::Preset& preset,
                                          const std::shared_ptr<const Scene>& scene, Watch& watch) {
  TRY(library, find_states(scene, preset.jitter, {.threads = 1, .lives = false}, watch));
  std::vector<record::StateRow> rows;
  for (const ShellState& state : library->states) rows.push_back(state.row);
  auto figures = record::figures_of(summary_of(preset, *scene, *library));
  append(figures, legs_of(&preset));
  append(figures, record::search_figures(library->search, rows));
  return figures;
}

using record::PointOutcome;
using record::PointResult;

constexpr double no_limit_s = 1e9;

/// Computes a point. An error of the point itself is part of its result; io and cancelled are
/// returned as errors.
Result<PointResult> result_of(const preset::SweepGrid& grid, std::size_t point, Watch& watch) {
  PointResult result;
  result.point = point;
  auto figures = figures_of(grid.at(point).preset, watch);
  if (figures) {
    result.figures = std::move(*figures);
    return result;
  }
  const Error& error = figures.error();
  if (error.fault == Fault::io || error.fault == Fault::cancelled)
    return tl::unexpected<Error>(error);
  result.reason = error.message;
  result.outcome =
      error.fault == Fault::bad_input ? PointOutcome::refused : PointOutcome::no_equilibrium;
  return result;
}

}  // namespace

Result<record::Figures> figures_of(const preset::Preset& requested, Watch& watch) {
  preset::Preset preset = requested;
  TRY(made, shared_scene_of(preset));
  const std::shared_ptr<const Scene>& scene = *made;
  if (preset.jitter.requested()) return figures_of_search(preset, scene, watch);
  // figures are those of the last state: the end, or of a path that ends early its last sample
  preset.figure.radii_mm.clear();
  preset.movie.frames = samples;
  const bool end_alone = preset.actuation.start == preset::Start::net;
  LastFrameSink sink;
  TRY(summary, run(preset, scene, end_alone, sink, watch));
  auto figures = record::figures_of(*summary);
  append(figures, more_of(scene.get(), sink.last()));
  append(figures, legs_of(&preset));
  return figures;
}

std::vector<std::string> figure_names(bool search) {
  auto figures = record::figures_of(record::Summary{});
  if (!search) append(figures, more_of(nullptr, {}));
  append(figures, legs_of(nullptr));
  if (search) append(figures, record::search_figures({}, {}));
  std::vector<std::string> names;
  for (auto& [name, figure] : figures) names.push_back(std::move(name));
  return names;
}

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
  Checksum sum;
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
    // each point reports its own progress, and all receive the same cancel
    TimeLimit none(no_limit_s, watch);
    TRY(result, result_of(grid, points[std::size_t(k)], none.watch()));
    const std::lock_guard lock(one_at_a_time);
    // after the first failure of `finished` it is not called again
    if (refused) return stopped();
    auto kept = finished(std::move(*result));
    refused = !kept;
    return kept;
  };
  return parallel_for(int(points.size()), jobs, watch, compute, reporting(watch));
}

}  // namespace gridshell::study
