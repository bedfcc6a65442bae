#include "engine/experiment/point.h"

#include <algorithm>
#include <utility>

#include "engine/experiment/experiment.h"
#include "engine/experiment/states.h"
#include "engine/record/legs.h"
#include "engine/record/search_figures.h"
#include "engine/record/summary_file.h"

namespace gridshell::experiment {
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

/// The figures of a run beyond its summary.
record::Figures more_of(const Scene* scene, const record::Frame& last) {
  record::Figure ratio;
  if (scene) {
    const RodMaterial& rod = scene->rods.materials.front();
    const double d = scene->footprint.spacing;
    ratio = rod.EA * d * d / std::min(rod.EI1, rod.EI2);
  }
  return {{"progress", known(last.progress)},
          {"depth_mm", known(last.depth_mm)},
          {"force_N", known(last.force_N)},
          {"stiffness_ratio", ratio}};
}

/// The legs of a circle; names alone where there is no preset.
record::Figures legs_of(const preset::Preset* preset) {
  record::Figures legs{{record::longest_leg_name, {}}, {record::shortest_leg_name, {}}};
  if (!preset || preset->footprint.kind != preset::FootprintKind::circle) return legs;
  const double radius = preset->original_radius_mm() / preset->footprint.spacing_mm;
  legs[0].second = record::longest_leg(radius, preset->footprint.rods);
  legs[1].second = record::shortest_leg(radius, preset->footprint.rods);
  return legs;
}

void append(record::Figures& figures, record::Figures more) {
  for (auto& one : more) figures.push_back(std::move(one));
}

/// A point that looks for states. Of each is asked what tells it apart, not how far back it lives.
Result<record::Figures> figures_of_search(const preset::Preset& preset,
                                          const std::shared_ptr<const Scene>& scene, Watch& watch) {
  const auto library = find_states(scene, preset.jitter, {.threads = 1, .lives = false}, watch);
  if (!library) return tl::unexpected<Error>(library.error());
  std::vector<record::StateRow> rows;
  for (const ShellState& state : library->states) rows.push_back(state.row);
  auto figures = record::figures_of(summary_of(preset, *scene, *library));
  append(figures, legs_of(&preset));
  append(figures, record::search_figures(library->search, rows));
  return figures;
}

}  // namespace

Result<record::Figures> figures_of(const preset::Preset& asked, Watch& watch) {
  preset::Preset preset = asked;
  const auto made = shared_scene_of(preset);
  if (!made) return tl::unexpected<Error>(made.error());
  const std::shared_ptr<const Scene>& scene = *made;
  if (preset.jitter.wanted()) return figures_of_search(preset, scene, watch);
  // the last state is what counts: the end, or where a path ends early the last sample before that
  preset.figure.radii_mm.clear();
  preset.movie.frames = samples;
  const bool end_alone = preset.actuation.start == preset::Start::net;
  LastFrameSink sink;
  const auto summary = run(preset, scene, end_alone, sink, watch);
  if (!summary) return tl::unexpected<Error>(summary.error());
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

}  // namespace gridshell::experiment
