#include "render/movie/bins_plot.h"

#include <algorithm>
#include <cmath>

#include "render/plot/ticks.h"

namespace gridshell::render {
namespace {

constexpr Colour reference{0.62f, 0.63f, 0.66f, 0.55f}, reference_ink{0.5f, 0.51f, 0.54f, 1},
    now_ink{0.13f, 0.33f, 0.60f, 1}, mean_ink{0.70f, 0.10f, 0.08f, 1};

Series bins_of(const record::Frame& frame) {
  Series series;
  const long count = frame.K_bins.rows();
  for (long k = 0; k < count; ++k) {
    series.x.push_back(-1 + (2.0 * double(k) + 1) / double(count));
    series.y.push_back(frame.K_bins(k, 0));
    series.y_error.push_back(frame.K_bins(k, 1));
  }
  return series;
}

// one row of the legend for a line across the plot
Series line_key(const std::string& name, const Stroke& stroke) {
  return {.name = name, .colour = stroke.colour, .line_width = stroke.width, .dash = stroke.dash};
}

}  // namespace

Plot bins_plot(const Survey& run, long cells, const record::Frame& frame,
               const std::optional<std::array<double, 2>>& range, double font_size) {
  const double low = std::min(0.0, run.bins_rad.low), high = std::max(0.0, run.bins_rad.high);
  const double margin = 0.06 * std::max(1e-9, high - low);
  Plot plot;
  plot.font_size = font_size;
  plot.x = {.label = "*x* / *L*", .low = -1, .high = 1};
  plot.y = {.label = "mean Gauss curvature *K*_{□} (rad)",
            .low = range ? (*range)[0] : low - (low < 0 ? margin : 0),
            .high = range ? (*range)[1] : high + margin};
  Series before = bins_of(run.first), now = bins_of(frame);
  before.name = "unloaded";
  before.kind = SeriesKind::bars;
  before.y_error.clear();
  before.bar_width = 1.9 / double(std::max<std::size_t>(1, before.x.size()));
  before.colour = reference;
  now.name = "now ± s.d.";
  now.colour = now_ink;
  now.line_width = 0;
  now.marker = Marker::circle;
  now.marker_size = 0.6 * font_size;
  const Stroke dashed{reference_ink, 0.08 * font_size, {0.35 * font_size, 0.25 * font_size}},
      solid{mean_ink, 0.1 * font_size, {}};
  plot.series = {before, now, line_key("all cells, unloaded", dashed),
                 line_key("all cells", solid)};
  plot.references = {{true, run.first.total_K / double(cells), "", dashed},
                     {true, frame.total_K / double(cells), "", solid}};
  plot.title = "Σ*K*_{□} = " + fixed(frame.total_K, 3) + " rad";
  plot.legend = LegendPlace::above;
  return plot;
}

}  // namespace gridshell::render
