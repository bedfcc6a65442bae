#include "app/window/colouring.h"

#include <algorithm>
#include <cmath>

#include "render/plot/ticks.h"

namespace gridshell::window {
namespace {

constexpr double paling = 0.2;  // of a map for rods, which are thin lines on white

struct ColourWords {
  ColourBy by;
  const char* label;
  const char* meaning;
};
constexpr ColourWords colour_words[] = {
    {ColourBy::none, "nothing", "rods and joints alone"},
    {ColourBy::K, "K□ (rad)", "integrated Gauss curvature of each cell"},
    {ColourBy::K_change, "ΔK□ (rad)", "its change since the shell was formed"},
    {ColourBy::deviation, "Δ/ρ", "distance of a cell's joints from the net, over ρ"},
    {ColourBy::energy, "bending (mJ/m)", "bending energy a length of rod"},
    {ColourBy::axial_force, "axial force (N)", "of the rods; below 0 they are compressed"},
    {ColourBy::displacement, "|u| (mm)", "how far each point moved since the shell was formed"},
};

static_assert(
    [] {
      for (std::size_t k = 0; k < std::size(colour_words); ++k)
        if (colour_words[k].by != ColourBy(k)) return false;
      return !is_enumerator<ColourBy(std::size(colour_words))>();
    }(),
    "every colour has its line in colour_words, in their order");

/// Both meshes' nodes lie at other places, but the joints come first in each.
Eigen::VectorXd displacement(const Sight& sight) {
  const Eigen::Matrix3Xd &now = sight.frame.nodes, &then = sight.first->nodes;
  if (now.cols() == then.cols()) return (now - then).colwise().norm().transpose();
  // by the joints, along the rods in between
  const record::Layout& layout = *sight.layout;
  const auto joints = int(layout.joints.size());
  const auto known = [&](int node) { return node < joints + int(layout.edge_points.size()); };
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(now.cols());
  for (const std::vector<int>& rod : layout.rods) {
    std::size_t last = 0;
    for (std::size_t k = 0; k < rod.size(); ++k) {
      if (!known(rod[k])) continue;
      moved[rod[k]] = (now.col(rod[k]) - then.col(rod[k])).norm();
      for (std::size_t between = last + 1; between < k; ++between) {
        const double part = double(between - last) / double(k - last);
        moved[rod[between]] = (1 - part) * moved[rod[last]] + part * moved[rod[k]];
      }
      last = k;
    }
  }
  return moved;
}

}  // namespace

const char* label_of(const Sight& sight, ColourBy by) {
  const bool surface = sight.design && sight.design->inverse.target == preset::Target::surface;
  if (by == ColourBy::deviation && surface) return "Δ/ρ from the surface";
  return colour_words[std::size_t(by)].label;
}
const char* meaning_of(ColourBy by) { return colour_words[std::size_t(by)].meaning; }

Values values_of(const Sight& sight, ColourBy by) {
  if (!sight.any()) return {};
  switch (by) {
    case ColourBy::none:
      return {};
    case ColourBy::K:
      return {sight.frame.cell_K, {}};
    case ColourBy::K_change:
      if (sight.first->cell_K.size() != sight.frame.cell_K.size()) return {};
      return {sight.frame.cell_K - sight.first->cell_K, {}};
    case ColourBy::deviation:
      return {sight.deviation, {}};
    case ColourBy::energy:
      return {{}, sight.bending_mJ_m};
    case ColourBy::axial_force:
      return {{}, sight.axial_N};
    case ColourBy::displacement:
      return {{}, displacement(sight)};
  }
  return {};
}

render::ColourScale scale_of(const Values& values, ColourBy by) {
  const Eigen::VectorXd& all = values.of_cells.size() > 0 ? values.of_cells : values.of_nodes;
  render::ColourScale scale =
      render::symmetric_scale(std::vector<double>(all.begin(), all.end()), 0.9);
  if (by == ColourBy::K || by == ColourBy::K_change || by == ColourBy::axial_force) {
    // round-off has no colour
    const double least = by == ColourBy::axial_force ? 1e-6 : 0.02;
    if (scale.high < least) scale.low = -least, scale.high = least;
    if (values.of_nodes.size() > 0) scale.start = paling;
    return scale;
  }
  const bool any = all.size() > 0 && all.maxCoeff() > 1e-9;
  // of these the farthest is what is asked for
  const bool whole = by == ColourBy::displacement || by == ColourBy::deviation;
  const double end = !any ? 1 : whole ? render::nice_ceiling(all.maxCoeff()) : scale.high;
  return {render::ColourMap::sequential, 0, end, values.of_nodes.size() > 0 ? paling : 0};
}

render::ColourScale next_scale(const render::ColourScale& before, const render::ColourScale& now,
                               RangeOf of) {
  render::ColourScale next = now;
  switch (of) {
    case RangeOf::state:
      break;
    case RangeOf::run:
      next.low = std::min(before.low, now.low);
      next.high = std::max(before.high, now.high);
      break;
    case RangeOf::hand:
      next.low = before.low;
      next.high = before.high;
      break;
  }
  return next;
}

}  // namespace gridshell::window
