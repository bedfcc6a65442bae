// Networks that are square grids get the families and indices of the grid.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/footprint/network.h"

namespace gridshell {
namespace {

constexpr double straight = 1e-9;   // allowed deviation of a rod's direction from u or v
constexpr double of_a_grid = 1e-6;  // allowed distance of a line from its grid line, over d

/// Index of a line in the grid; empty: it is not on the grid.
std::optional<int> line_number(Placement placement, double line, double spacing) {
  const double k = line / spacing - (placement == Placement::half ? 0.5 : 0);
  if (std::abs(k - std::round(k)) > of_a_grid) return std::nullopt;
  return int(std::lround(k));
}

/// A rod along u or v as a rod of the square grid, with positions u or v; empty: it is not on the
/// grid.
std::optional<FootprintRod> grid_rod(const FootprintRod& rod, const Footprint& footprint) {
  const bool u = std::abs(rod.direction.y()) < straight, v = std::abs(rod.direction.x()) < straight;
  if (!rod.path.empty() || u == v || rod.begin == RodEnd::joined || rod.end == RodEnd::joined)
    return std::nullopt;
  const int along = u ? 0 : 1;
  const double line = rod.origin[1 - along];
  const auto number = line_number(footprint.placement, line, footprint.spacing);
  if (!number) return std::nullopt;
  const double first = rod.at(rod.span.begin)[along], last = rod.at(rod.span.end)[along];
  auto named = FootprintRod::of_grid(u ? Family::u : Family::v, *number, line,
                                     {std::min(first, last), std::max(first, last)});
  named.joints = rod.joints;
  if (first > last) std::ranges::reverse(named.joints);
  for (const int joint : named.joints) {
    const FootprintJoint& at = footprint.joints[joint];
    named.marks.push_back(u ? at.u : at.v);
  }
  named.begin = first > last ? rod.end : rod.begin;
  named.end = first > last ? rod.begin : rod.end;
  named.number = rod.number;
  named.reversed = first > last;
  return named;
}

}  // namespace

void name_as_grid(NetworkFootprint& network, Placement placement) {
  NetworkFootprint named = network;
  Footprint& grid = named.footprint;
  grid.placement = placement;
  std::vector<std::size_t> order(grid.rods.size());
  for (std::size_t r = 0; r < grid.rods.size(); ++r) {
    const FootprintRod given = grid.rods[r];
    const auto rod = grid_rod(given, grid);
    if (!rod) return;
    grid.rods[r] = *rod;
    const int along = rod->family == Family::u ? 0 : 1;
    if (given.at(given.span.begin)[along] > given.at(given.span.end)[along])
      std::swap(named.ends[2 * r], named.ends[2 * r + 1]);
    order[r] = r;
  }
  std::vector<std::array<int, 2>> through(grid.joints.size());  // u-rods, v-rods
  for (const FootprintRod& rod : grid.rods)
    for (const int joint : rod.joints) {
      const bool u = rod.family == Family::u;
      ++through[joint][u ? 0 : 1];
      (u ? grid.joints[joint].j : grid.joints[joint].i) = rod.index;
    }
  if (std::ranges::any_of(through, [](const auto& rods) { return rods != std::array{1, 1}; }))
    return;
  std::ranges::stable_sort(
      order, {}, [&](std::size_t r) { return std::pair(grid.rods[r].family, grid.rods[r].index); });
  auto points = std::move(network.footprint.joints);
  network = named;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t r = order[k];
    network.footprint.rods[k] = grid.rods[r];
    network.ends[2 * k] = named.ends[2 * r];
    network.ends[2 * k + 1] = named.ends[2 * r + 1];
  }
  find_cells(network.footprint);
  network.footprint.joints = std::move(points);
}

}  // namespace gridshell
