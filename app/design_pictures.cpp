#include "app/design_pictures.h"

#include <fmt/format.h>

#include "app/net_pictures.h"
#include "app/pictures.h"
#include "render/plot/plot.h"

namespace gridshell::app {
namespace fs = std::filesystem;
namespace {

/// Distances of the joints over the iterations, per cent of the length scale; crosses: refused.
render::Plot convergence_plot(const Designed& found, const std::string& title) {
  render::Series largest{"largest"}, mean{"mean"}, refused{"step refused"};
  largest.colour = render::series_colour(0);
  mean.colour = render::series_colour(1);
  largest.marker = mean.marker = render::Marker::circle;
  refused.colour = {0.3f, 0.3f, 0.3f, 1};
  refused.marker = render::Marker::cross;
  refused.line_width = 0;
  render::Plot plot;
  const double percent = 100 / found.length_scale_mm;
  double norm = 2;
  for (std::size_t k = 0; k < found.steps.size(); ++k) {
    const DesignStep& step = found.steps[k];
    largest.x.push_back(step.iteration);
    largest.y.push_back(percent * step.max_mm);
    mean.x.push_back(step.iteration);
    mean.y.push_back(percent * step.mean_mm);
    if (k > 0 && !step.taken) {
      refused.x.push_back(step.iteration);
      refused.y.push_back(percent * step.max_mm);
    }
    if (step.norm == norm) continue;
    plot.references.push_back({false, step.iteration - 0.5, fmt::format("*p* = {:g}", step.norm)});
    norm = step.norm;
  }
  plot.title = title;
  plot.x.label = "iteration";
  plot.y.label = "distance of joints (% of *ρ*)";
  plot.y.logarithmic = true;
  plot.series = {largest, mean};
  if (!refused.x.empty()) plot.series.push_back(refused);
  return plot;
}

/// A run whose net is what it is to meet: of every node the nearest point of the target.
Result<void> put_target(CaseRecord& one) {
  auto nearest = nearest_to(one.preset, one.run.layout.flat_nodes, one.run.frames.back().nodes);
  if (!nearest) return tl::unexpected(nearest.error());
  one.run.layout.net_nodes = std::move(*nearest);
  return {};
}

}  // namespace

Result<void> draw_design(CaseRecord before, CaseRecord after, const Designed& found,
                         render::Renderer& renderer, const fs::path& stem, Watch& watch) {
  std::vector<CaseRecord> records;
  for (CaseRecord* one : {&before, &after}) {
    if (auto put = put_target(*one); !put) return put;
    records.push_back(std::move(*one));
  }
  const auto style = style_of(records.front().preset, Pictures::stills);
  fs::path convergence = stem;
  convergence += "_convergence";
  return draw_net_pictures(records, renderer, stem, watch).and_then([&] {
    return render::write_plot(convergence, convergence_plot(found, render::plain(style.title)),
                              style.print);
  });
}

}  // namespace gridshell::app
