#include "render/movie/bins_plot.h"

#include <algorithm>
#include <cmath>

#include "render/plot/ticks.h"

namespace gridshell::render {
namespace {

constexpr Colour reference{0.62f, 0.63f, 0.66f, 0.55f}, reference_ink{0.5f, 0.51f, 0.54f, 1},
    now_ink{0.13f, 0.33f, 0.60f, 1}, total_ink{0.70f, 0.10f, 0.08f, 1};

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

}  // namespace

Plot bins_plot(const record::Trajectory& run, int index, double font_size) {
  const record::Frame& first = run.frames.front();
  const record::Frame& frame = run.frames[std::size_t(index)];
  const double cells = double(run.layout.cells.size());
  double low = 0, high = 0;
  for (const record::Frame& any : run.frames)
    for (long k = 0; k < any.K_bins.rows(); ++k) {
      if (!std::isfinite(any.K_bins(k, 0))) continue;
      low = std::min(low, any.K_bins(k, 0) - any.K_bins(k, 1));
      high = std::max(high, any.K_bins(k, 0) + any.K_bins(k, 1));
    }
  const double margin = 0.06 * std::max(1e-9, high - low);
  Plot plot;
  plot.font_size = font_size;
  plot.x = {.label = "*x* / *L*", .low = -1, .high = 1};
  plot.y = {.label = "*K*_{□} of a cell (rad)", .low = low - margin, .high = high + 3 * margin};
  Series before = bins_of(first), now = bins_of(frame);
  before.name = "unloaded";
  before.kind = SeriesKind::bars;
  before.bar_width = 1.9 / double(std::max<std::size_t>(1, before.x.size()));
  before.colour = reference;
  now.name = "mean and deviation";
  now.colour = now_ink;
  now.line_width = 0;
  now.marker = Marker::circle;
  now.marker_size = 0.6 * font_size;
  plot.series = {before, now};
  plot.references = {{true, first.total_K / cells, "", {reference_ink, 0.08 * font_size, {4, 3}}},
                     {true, frame.total_K / cells, "", {total_ink, 0.1 * font_size, {}}}};
  plot.title = "line: mean over all cells; total " + fixed(frame.total_K, 3) + " rad";
  return plot;
}

}  // namespace gridshell::render
