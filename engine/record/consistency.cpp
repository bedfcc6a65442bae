#include "engine/record/consistency.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
  for (std::size_t k = 0; k < layout.supports.size(); ++k)
    if (outside(layout.supports[k], nodes))
      return out_of_range("support", k, "node", layout.supports[k], nodes);
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

// what coordinates may come to: their products must stay numbers
constexpr double largest_mm = 1e9;

bool computable(const Eigen::Matrix3Xd& points) {
  return points.size() == 0 || points.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= largest_mm;
}

Result<void> check_numbers(const Layout& layout) {
  const auto refuse = [](const char* what) {
    return fail(Fault::bad_input, fmt::format("{} holds a number that is no length in mm", what));
  };
  for (const double length : {layout.spacing_mm, layout.rod_diameter_mm, layout.length_scale_mm})
    if (!(length >= 0 && length <= largest_mm)) return refuse("/layout");
  for (const double diameter : layout.diameters_mm)
    if (!(diameter >= 0 && diameter <= largest_mm)) return refuse("a rod's diameter");
  if (!computable(layout.original_boundary) || !computable(layout.actuated_boundary))
    return refuse("a boundary");
  if (!computable(layout.net_nodes) || !computable(layout.flat_nodes)) return refuse("the net");
  for (const Part& part : layout.parts)
    if (!computable(part.net) || !computable(part.flat)) return refuse("a block");
  for (const Joint& joint : layout.joints)
    if (!(std::max(std::abs(joint.u_mm), std::abs(joint.v_mm)) <= largest_mm))
      return refuse("a joint");
  for (const LoadedJoint& load : layout.loaded_joints)
    if (!(std::abs(load.direction.norm() - 1) <= 1e-6))
      return fail(Fault::bad_input, "the direction of a loaded joint is no unit vector");
  return {};
}

// rods are paths over the nodes, a joint being on two: longer lists are nobody's shell
Result<void> check_sizes(const Layout& layout, Eigen::Index nodes) {
  Eigen::Index named = 0, most = 0;
  for (const auto& rod : layout.rods) {
    named += Eigen::Index(rod.size());
    for (const int node : rod) most = std::max<Eigen::Index>(most, node + 1);
  }
  if (named > 4 * nodes)
    return fail(Fault::bad_input, fmt::format("the rods name {} nodes of {}", named, nodes));
  most = std::max<Eigen::Index>(most, Eigen::Index(layout.joints.size()));
  if (!layout.families.empty() && layout.families.size() != layout.rods.size())
    return fail(Fault::bad_input, fmt::format("{} families are named for {} rods",
                                              layout.families.size(), layout.rods.size()));
  if (!layout.diameters_mm.empty() && layout.diameters_mm.size() != layout.rods.size())
    return fail(Fault::bad_input, fmt::format("{} diameters are given for {} rods",
                                              layout.diameters_mm.size(), layout.rods.size()));
  for (const auto* net : {&layout.net_nodes, &layout.flat_nodes})
    if (net->cols() > 0 && net->cols() < most)
      return fail(Fault::bad_input,
                  fmt::format("the net has {} nodes, the shell {}", net->cols(), most));
  return {};
}

}  // namespace

Result<void> check_layout(const Layout& layout, Eigen::Index nodes) {
  if (layout.original_boundary.cols() != layout.actuated_boundary.cols())
    return fail(Fault::bad_input,
                fmt::format("the original boundary has {} points, the actuated one {}",
                            layout.original_boundary.cols(), layout.actuated_boundary.cols()));
  return check_indices(layout, nodes)
      .and_then([&] { return check_sizes(layout, nodes); })
      .and_then([&] { return check_numbers(layout); });
}

Result<void> check_frame(const Layout& layout, const Frame& frame, std::size_t k,
                         Eigen::Index nodes) {
  const auto cells = static_cast<Eigen::Index>(layout.cells.size());
  if (frame.nodes.cols() != nodes)
    return fail(Fault::bad_input, fmt::format("frame {} has {} nodes, the first one {}", k,
                                              frame.nodes.cols(), nodes));
  if (frame.cell_K.size() != cells)
    return fail(Fault::bad_input, fmt::format("frame {} has {} values of cell_K for {} cells", k,
                                              frame.cell_K.size(), cells));
  const auto fits = [&](const char* what, Eigen::Index values,
                        Eigen::Index wanted) -> Result<void> {
    if (values == 0 || values == wanted) return {};
    return fail(Fault::bad_input,
                fmt::format("frame {} has {} values of {}, must be {}", k, values, what, wanted));
  };
  return fits("axial_force_N", frame.axial_force_N.size(), edges_of_rods(layout))
      .and_then([&] {
        return fits("curvature_per_mm", frame.curvature_per_mm.size(), points_of_rods(layout));
      })
      .and_then([&] {
        return fits("bending_mJ_per_m", frame.bending_mJ_per_m.size(), points_of_rods(layout));
      })
      .and_then([&] {
        return fits("reactions_N", frame.reactions_N.cols(), Eigen::Index(layout.supports.size()));
      });
}

Result<void> check_consistency(const Trajectory& trajectory) {
  const Layout& layout = trajectory.layout;
  const FrameList& frames = trajectory.frames;
  // without a frame nobody knows how many nodes there are
  const Eigen::Index nodes = frames.empty() ? 0 : frames.front().nodes.cols();
  if (!frames.empty() || layout.original_boundary.cols() != layout.actuated_boundary.cols())
    if (auto fits = check_layout(layout, nodes); !fits) return fits;
  for (std::size_t k = 0; k < frames.size(); ++k)
    if (auto fits = check_frame(layout, frames[k], k, nodes); !fits) return fits;
  return {};
}

}  // namespace gridshell::record
