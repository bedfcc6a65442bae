#include "render/movie/run_summary.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "engine/record/frame_values.h"

namespace gridshell::render {
namespace {

Eigen::VectorXd change_of_K(const record::Frame& first, const record::Frame& frame) {
  if (first.cell_K.size() != frame.cell_K.size()) return {};
  return frame.cell_K - first.cell_K;
}

Eigen::VectorXd move_over_depth(const ColourOrigin& from, const record::Frame& frame) {
  if (from.depth_mm <= 0 || from.first.nodes.cols() != frame.nodes.cols())
    return Eigen::VectorXd::Zero(frame.nodes.cols());
  return (frame.nodes - from.first.nodes).colwise().norm() / from.depth_mm;
}

/// A quantity that is coloured.
struct Quantity {
  const char *label = "", *words = "";  // symbol with unit, and name, of the colour bar
  bool cells = false;                   // whether it has values of cells; else of nodes
  bool may_be_missing = false;
  double least_end = 0;     // smallest end of the scale, so that round-off is not coloured
  bool size = false;        // whether it is never negative
  bool from_least = false;  // whether the scale begins at the smallest value, not at zero
  double part = 0.9;        // fraction of the cells or nodes that are within the scale
};

const Quantity& quantity_of(ColourBy by) {
  static const std::map<ColourBy, Quantity> quantities{
      {ColourBy::none, {}},
      {ColourBy::K, {"*K*_{□} (rad)", "integrated Gauss curvature", true, false, 0.02}},
      {ColourBy::K_change,
       {"Δ*K*_{□} (rad)", "change of integrated Gauss curvature", true, false, 0.02}},
      {ColourBy::deviation, {"Δ/*ρ* (%)", "deviation from the net", true, true, 1e-4, true}},
      {ColourBy::displacement,
       {"|*u*| / *δ*_{0}", "displacement over depth", false, false, 0, true, false, 1}},
      {ColourBy::energy, {"*e*_{b} (mJ/m)", "bending energy over length", false, true, 1e-6, true}},
      {ColourBy::axial_force, {"*N* (N)", "axial force", false, true, 1e-6}},
      {ColourBy::stress,
       {"*σ* (MPa)", "largest stress of a fibre", false, true, 1e-3, true, false, 1}},
      {ColourBy::utilisation,
       {"*σ* / strength", "utilisation of the rods", false, true, 1e-3, true, false, 1}},
      {ColourBy::joint_angle,
       {"*α* (°)", "angle between the rods at joints", false, true, 0.01, true, true}}};
  return quantities.at(by);
}

constexpr double paling = 0.2;  // ColourScale::start for rods, which are thin lines on white

using Surveys = std::vector<const RunSummary*>;

Interval all_of(const Surveys& runs, ColourBy by) {
  Interval all;
  for (const RunSummary* run : runs)
    if (by != ColourBy::displacement)
      all.take(run->spread(by).all);
    else if (run->depth_mm > 0)
      all.take(run->largest_move_mm / run->depth_mm);
  return all;
}

// a colour bar of the largest magnitudes of each cell or node
ColourBar bar_of_sizes(const Surveys& runs, ColourBy by) {
  std::vector<double> most;
  for (const RunSummary* run : runs)
    most.insert(most.end(), run->spread(by).most.begin(), run->spread(by).most.end());
  const Interval all = all_of(runs, by);
  ColourBar bar = named_bar(by, colour_scale(by, std::move(most), all));
  bar.below_scale = all.any() && !quantity_of(by).size && all.low < bar.scale.low;
  bar.above_scale = all.any() && all.high > bar.scale.high;
  return bar;
}

ColourBar displacement_bar(const Surveys& runs) {
  ColourBar bar = named_bar(ColourBy::displacement, {sequential, 0, 1, paling});
  for (const RunSummary* run : runs)
    bar.above_scale |= run->depth_mm > 0 && run->largest_move_mm > 1.02 * run->depth_mm;
  return bar;
}

}  // namespace

bool of_cells(ColourBy by) { return quantity_of(by).cells; }

bool may_be_missing(ColourBy by) { return quantity_of(by).may_be_missing; }

Eigen::VectorXd coloured_values(ColourBy by, const record::Layout& layout,
                                const record::Frame& frame, const ColourOrigin& from) {
  switch (by) {
    case ColourBy::none:
      return {};
    case ColourBy::K:
      return frame.cell_K;
    case ColourBy::K_change:
      return change_of_K(from.first, frame);
    case ColourBy::deviation:
      return 100 * record::deviation_of_cells(layout, frame);
    case ColourBy::displacement:
      return move_over_depth(from, frame);
    case ColourBy::energy:
      return record::bending_of_nodes_mJ_per_m(layout, frame);
    case ColourBy::axial_force:
      return record::axial_force_of_nodes_N(layout, frame);
    case ColourBy::stress:
    case ColourBy::utilisation:
      return record::stress_of_nodes_MPa(layout, frame, by == ColourBy::utilisation);
    case ColourBy::joint_angle:
      return record::joint_angle_of_nodes_deg(layout, frame);
  }
  return {};
}

tl::unexpected<Error> missing_values_error(ColourBy by) {
  const std::string requested = fmt::format("[movie] colour_by = \"{}\"", word_of(by));
  if (by == ColourBy::deviation) return invalid(requested + ": the run has no net");
  if (by == ColourBy::joint_angle)
    return invalid(requested + ": no joint has a law or a spring, whose angles are shown");
  return invalid(
      "{}: the run has no {} of its rods, as those of an older version and of a net; run it again",
      requested,
      by == ColourBy::axial_force ? "axial forces"
      : by == ColourBy::energy    ? "bending energy"
      : by == ColourBy::stress    ? "stress"
                                  : "strength");
}

ColourScale colour_scale(ColourBy by, std::vector<double> sizes, const Interval& all) {
  const Quantity& quantity = quantity_of(by);
  const double largest = all.any() ? std::max(std::abs(all.low), std::abs(all.high)) : 0;
  double end = std::max(symmetric_scale(std::move(sizes), quantity.part).high, quantity.least_end);
  // symmetric, so that a colour means one sign in all pictures
  if (!quantity.size && largest < quantity.least_end) end = quantity.least_end;
  ColourScale scale{quantity.size ? sequential : diverging, quantity.size ? 0 : -end, end,
                    quantity.cells ? 0 : paling};
  if (quantity.from_least && all.any()) {
    scale.low = all.low;
    scale.high = std::max(all.high, all.low + quantity.least_end);
  }
  return scale;
}

ColourBar named_bar(ColourBy by, const ColourScale& scale) {
  return {.label = quantity_of(by).label, .scale = scale, .words = quantity_of(by).words};
}

std::optional<ColourBar> colour_bar_of(const Surveys& runs, const MovieStyle& style) {
  const ColourBy by = style.colour_by;
  const bool any_cell = std::ranges::any_of(
      runs, [&](const RunSummary* run) { return run->spread(by).most.size() > 0; });
  if (runs.empty() || by == ColourBy::none) return std::nullopt;
  if (of_cells(by) && (!any_cell || !style.look.cells)) return std::nullopt;
  ColourBar bar = by == ColourBy::displacement ? displacement_bar(runs) : bar_of_sizes(runs, by);
  if (style.look.map) bar.scale.map = style.look.map;
  if (style.look.range.empty()) return bar;
  bar.scale.low = style.look.range[0];
  bar.scale.high = style.look.range[1];
  const Interval all = all_of(runs, by);
  bar.below_scale = all.any() && all.low < bar.scale.low;
  bar.above_scale = all.any() && all.high > bar.scale.high;
  return bar;
}

}  // namespace gridshell::render
