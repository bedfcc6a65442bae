#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "render/canvas/text.h"
#include "render/movie/run_plots.h"

namespace gridshell::render {
namespace {

constexpr Colour reference{0.62f, 0.63f, 0.66f, 0.55f}, reference_ink{0.5f, 0.51f, 0.54f, 1},
    now_ink{0.13f, 0.33f, 0.60f, 1}, mean_ink{0.70f, 0.10f, 0.08f, 1};

/// "Σ*K*_{□} = 5.898 rad, −1.78 %": the sum and its change, which is in rad if the first sum is
/// nearly zero.
std::string total_K_caption(double first, double now) {
  const double change = now - first;
  const bool relative = std::abs(first) > 0.1;
  const std::string size =
      fixed(relative ? 100 * change / std::abs(first) : change, relative ? 2 : 3);
  return fmt::format("Σ*K*_{{□}} = {} rad, {}{}{}", fixed(now, 3), change > 0 ? "+" : "", size,
                     relative ? " %" : " rad");
}

Series bins_of(const record::Frame& frame) {
  Series series;
  const long count = frame.K_bins.rows();
  for (long k = 0; k < count; ++k) {
    series.add(-1 + (2.0 * double(k) + 1) / double(count), frame.K_bins(k, 0));
    series.y_error.push_back(frame.K_bins(k, 1));
  }
  series.bar_width = 1.9 / double(std::max(1L, count));
  return series;
}

}  // namespace

Plot bins_plot(const RunSummary& run, long cells, const record::Frame& frame,
               const std::vector<double>& range, double font_size) {
  const double low = std::min(0.0, run.bins_rad.low), high = std::max(0.0, run.bins_rad.high);
  const double margin = 0.06 * std::max(1e-9, high - low);
  Plot plot;
  plot.font_size = font_size;
  plot.x = {.label = "*x*/*L*", .low = -1, .high = 1};
  plot.y = {.label = "mean *K*_{□} (rad)",
            .low = !range.empty() ? range[0] : low - (low < 0 ? margin : 0),
            .high = !range.empty() ? range[1] : high + margin};
  Series before = bins_of(run.first), now = bins_of(frame);
  const bool pushed = std::isfinite(frame.depth_mm);
  const std::string first = pushed ? "unloaded" : "first state", last = pushed ? "loaded" : "now";
  before.name = first + ", mean ± s.d. (left)";
  before.kind = SeriesKind::bars;
  before.colour = reference;
  // both error bars are visible, side by side
  Series spread = mark_series("", reference_ink, Marker::none);
  for (std::size_t k = 0; k < before.x.size(); ++k) {
    spread.add(before.x[k] - 0.14 * before.bar_width, before.y[k]);
    now.x[k] += 0.14 * before.bar_width;
  }
  spread.y_error = std::exchange(before.y_error, {});
  now.name = last + ", mean ± s.d. (right)";
  now.colour = now_ink;
  now.line_width = 0;
  now.marker = Marker::circle;
  now.marker_size = spread.marker_size = 0.6 * font_size;
  const Stroke dashed{reference_ink, 0.08 * font_size, {0.35 * font_size, 0.25 * font_size}},
      solid{mean_ink, 0.1 * font_size, {}};
  // empty series, for the rows of the legend of the lines across the plot
  plot.series = {
      before, spread, now,
      line_series("mean of all cells, " + first, dashed.colour, dashed.width, dashed.dash),
      line_series("mean of all cells, " + last, solid.colour, solid.width)};
  plot.references = {{true, run.first.total_K / double(cells), "", dashed},
                     {true, frame.total_K / double(cells), "", solid}};
  plot.title = total_K_caption(run.first.total_K, frame.total_K);
  plot.legend = LegendPosition::above;
  return plot;
}

Plot change_plot(const RunSummary& run, const record::Frame& frame, double font_size) {
  Series change = bins_of(frame);
  const Series first = bins_of(run.first);
  change.y_error.clear();
  for (std::size_t k = 0; k < change.y.size(); ++k) change.y[k] -= first.y[k];
  change.kind = SeriesKind::bars;
  change.colour = now_ink;
  const double end =
      1.1 * std::max({1e-6, std::abs(run.bins_change_rad.low), std::abs(run.bins_change_rad.high)});
  Plot plot;
  plot.font_size = font_size;
  plot.legend = LegendPosition::none;
  plot.x = {.label = "*x*/*L*", .low = -1, .high = 1};
  plot.y = {.label = "change (rad)", .low = -end, .high = end, .ticks = 4};
  plot.references = {{true, 0, "", {reference_ink, 0.08 * font_size, {}}}};
  plot.series = {change};
  return plot;
}

}  // namespace gridshell::render
