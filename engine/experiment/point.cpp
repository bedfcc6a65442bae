#include "engine/experiment/point.h"

#include <algorithm>
#include <utility>

#include "engine/experiment/experiment.h"
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

}  // namespace

Result<record::Figures> figures_of(const preset::Preset& asked, Watch& watch) {
  preset::Preset preset = asked;
  auto made = scene_of(preset);
  if (!made) return tl::unexpected<Error>(made.error());
  const auto scene = std::make_shared<const Scene>(std::move(*made));
  // the last state is what counts: the end, or where a path ends early the last sample before that
  preset.figure.radii_mm.clear();
  preset.movie.frames = samples;
  const bool end_alone = preset.actuation.start == preset::Start::net;
  LastFrameSink sink;
  const auto summary = run(preset, scene, end_alone, sink, watch);
  if (!summary) return tl::unexpected<Error>(summary.error());
  auto figures = record::figures_of(*summary);
  for (auto& more : more_of(scene.get(), sink.last())) figures.push_back(std::move(more));
  return figures;
}

std::vector<std::string> figure_names() {
  auto figures = record::figures_of(record::Summary{});
  for (auto& more : more_of(nullptr, {})) figures.push_back(std::move(more));
  std::vector<std::string> names;
  for (auto& [name, figure] : figures) names.push_back(std::move(name));
  return names;
}

}  // namespace gridshell::experiment
