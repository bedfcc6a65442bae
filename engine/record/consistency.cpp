#include "engine/record/consistency.h"

#include <fmt/format.h>

namespace gridshell::record {
namespace {

/// "rod 3 names node 99 of 50"
tl::unexpected<Error> out_of_range(const char* owner, std::size_t at, const char* kind, int index,
                                   Eigen::Index count) {
  return fail(Fault::bad_input,
              fmt::format("{} {} names {} {} of {}", owner, at, kind, index, count));
}

bool outside(int index, Eigen::Index count) { return index < 0 || index >= count; }

Result<void> check_indices(const Layout& layout, Eigen::Index nodes) {
  for (std::size_t r = 0; r < layout.rods.size(); ++r)
    for (const int node : layout.rods[r])
      if (outside(node, nodes)) return out_of_range("rod", r, "node", node, nodes);
  for (std::size_t k = 0; k < layout.joints.size(); ++k)
    if (outside(layout.joints[k].node, nodes))
      return out_of_range("joint", k, "node", layout.joints[k].node, nodes);
  for (std::size_t k = 0; k < layout.edge_points.size(); ++k)
    if (outside(layout.edge_points[k], nodes))
      return out_of_range("edge point", k, "node", layout.edge_points[k], nodes);
  const auto joints = static_cast<Eigen::Index>(layout.joints.size());
  for (std::size_t k = 0; k < layout.cells.size(); ++k)
    for (const int joint : layout.cells[k].joints)
      if (outside(joint, joints)) return out_of_range("cell", k, "joint", joint, joints);
  for (std::size_t k = 0; k < layout.loaded_joints.size(); ++k)
    if (outside(layout.loaded_joints[k].joint, joints))
      return out_of_range("loaded joint", k, "joint", layout.loaded_joints[k].joint, joints);
  for (const Part& part : layout.parts) {
    if (part.net.cols() != part.flat.cols())
      return fail(Fault::bad_input, fmt::format("block \"{}\" has {} points on its net and {} in "
                                                "the flat",
                                                part.name, part.net.cols(), part.flat.cols()));
    for (std::size_t r = 0; r < part.rods.size(); ++r)
      for (const int point : part.rods[r])
        if (outside(point, part.net.cols()))
          return out_of_range("rod", r, "point", point, part.net.cols());
  }
  return {};
}

}  // namespace

Result<void> check_consistency(const Trajectory& trajectory) {
  const Layout& layout = trajectory.layout;
  if (layout.original_boundary.cols() != layout.actuated_boundary.cols())
    return fail(Fault::bad_input,
                fmt::format("the original boundary has {} points, the actuated one {}",
                            layout.original_boundary.cols(), layout.actuated_boundary.cols()));
  if (trajectory.frames.empty()) return {};
  const Eigen::Index nodes = trajectory.frames.front().nodes.cols();
  const auto cells = static_cast<Eigen::Index>(layout.cells.size());
  for (std::size_t k = 0; k < trajectory.frames.size(); ++k) {
    const Frame& frame = trajectory.frames[k];
    if (frame.nodes.cols() != nodes)
      return fail(Fault::bad_input, fmt::format("frame {} has {} nodes, the first one {}", k,
                                                frame.nodes.cols(), nodes));
    if (frame.cell_K.size() != cells)
      return fail(Fault::bad_input, fmt::format("frame {} has {} values of cell_K for {} cells", k,
                                                frame.cell_K.size(), cells));
  }
  return check_indices(layout, nodes);
}

}  // namespace gridshell::record
