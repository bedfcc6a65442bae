#include "render/movie/colour_range.h"

#include <algorithm>

namespace gridshell::render {
namespace {

constexpr double quantile = 0.9;    // of the cells lie within the scale
constexpr double least_end = 0.02;  // rad: below, a shell that is not curved would look curved
constexpr double one_sign = 0.05;   // the other side's share of the larger one that is no sign

ColourBar curvature_bar(const std::vector<const Survey*>& runs, bool change) {
  std::vector<double> most;
  Interval all;
  for (const Survey* run : runs) {
    const Eigen::ArrayXd& values = change ? run->most_K_change : run->most_K;
    most.insert(most.end(), values.begin(), values.end());
    all.take(change ? run->K_change : run->K);
  }
  ColourBar bar{change ? "Δ*K*_{□} (rad)" : "*K*_{□} (rad)", symmetric_scale(most, quantile)};
  const double end = std::max(bar.scale.high, least_end);
  const bool positive = all.any() && -all.low < one_sign * all.high;
  const bool negative = all.any() && all.high < -one_sign * all.low;
  bar.words = change ? "change of Gauss curvature" : "Gauss curvature of a cell";
  bar.scale = {positive || negative ? ColourMap::sequential : ColourMap::diverging,
               positive ? 0 : -end, negative ? 0 : end};
  if (all.any()) {
    bar.beyond_low = all.low < bar.scale.low && !positive;
    bar.beyond_high = all.high > bar.scale.high && !negative;
  }
  return bar;
}

ColourBar displacement_bar(const std::vector<const Survey*>& runs) {
  ColourBar bar{"|*u*| / *δ*_{0}", {ColourMap::sequential, 0, 1, 0.2}};
  bar.words = "displacement over depth";
  for (const Survey* run : runs)
    bar.beyond_high |= run->depth_mm > 0 && run->largest_move_mm > 1.02 * run->depth_mm;
  return bar;
}

}  // namespace

std::optional<ColourBar> colour_bar_of(const std::vector<const Survey*>& runs,
                                       const MovieStyle& style) {
  const bool of_rods = style.colour_by == ColourBy::displacement;
  const bool any_cell = std::any_of(runs.begin(), runs.end(),
                                    [](const Survey* run) { return run->most_K.size() > 0; });
  if (runs.empty() || style.colour_by == ColourBy::none) return std::nullopt;
  if (!of_rods && (!any_cell || !style.look.cells)) return std::nullopt;
  ColourBar bar =
      of_rods ? displacement_bar(runs) : curvature_bar(runs, style.colour_by == ColourBy::K_change);
  if (style.look.map) bar.scale.map = *style.look.map;
  if (!style.look.range) return bar;
  bar.scale.low = (*style.look.range)[0];
  bar.scale.high = (*style.look.range)[1];
  Interval all;
  for (const Survey* run : runs) {
    if (of_rods && run->depth_mm > 0) all.take(run->largest_move_mm / run->depth_mm);
    if (!of_rods) all.take(style.colour_by == ColourBy::K_change ? run->K_change : run->K);
  }
  bar.beyond_low = all.any() && all.low < bar.scale.low;
  bar.beyond_high = all.any() && all.high > bar.scale.high;
  return bar;
}

}  // namespace gridshell::render
