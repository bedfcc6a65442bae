#include <fmt/format.h>

#include <algorithm>

#include "render/gl/scene.h"

namespace gridshell::render {

std::string drawing_error(const Drawing& drawing) {
  if (!drawing.layout) return "has no layout";
  const auto nodes = std::size_t(drawing.nodes.cols());
  const auto& layout = *drawing.layout;
  if (!drawing.nodes.allFinite()) return "has a node that is not finite";
  if (!drawing.node_colours.empty() && drawing.node_colours.size() != nodes)
    return fmt::format("has {} node colours for {} nodes", drawing.node_colours.size(), nodes);
  if (!drawing.cell_colours.empty() && drawing.cell_colours.size() != layout.cells.size())
    return fmt::format("has {} cell colours for {} cells", drawing.cell_colours.size(),
                       layout.cells.size());
  const auto missing = [](int index, std::size_t count) {
    return index < 0 || std::size_t(index) >= count;
  };
  const auto outside = [&](const std::vector<std::vector<int>>& rods, std::size_t count) {
    return std::ranges::any_of(rods, [&](const auto& rod) {
      return std::ranges::any_of(rod, [&](int node) { return missing(node, count); });
    });
  };
  if (outside(layout.rods, nodes))
    return fmt::format("has a rod with more than its {} nodes", nodes);
  for (const auto& joint : layout.joints)
    if (missing(joint.node, nodes))
      return fmt::format("has joint ({}, {}) outside its {} nodes", joint.i, joint.j, nodes);
  for (const int node : layout.above)
    if (missing(node, nodes)) return fmt::format("has an upper rod outside its {} nodes", nodes);
  for (const auto& cell : layout.cells)
    for (const int joint : cell.joints)
      if (missing(joint, layout.joints.size()))
        return fmt::format("has cell ({}, {}) outside its {} joints", cell.i, cell.j,
                           layout.joints.size());
  for (const auto& ghost : drawing.ghosts)
    if (!ghost.nodes.allFinite() || outside(ghost.rods, std::size_t(ghost.nodes.cols())))
      return "has ghost rods with a node that is missing or not finite";
  for (const auto& ring : drawing.rings)
    if (!ring.points.allFinite()) return "has a ring with a point that is not finite";
  for (const auto& arrow : drawing.arrows)
    if (!arrow.from.allFinite() || !arrow.to.allFinite()) return "has an arrow that is not finite";
  for (const auto& mark : drawing.marks)
    if (!mark.at.allFinite()) return "has a mark that is not finite";
  return {};
}

}  // namespace gridshell::render
