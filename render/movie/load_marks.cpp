#include "render/movie/load_marks.h"

#include <algorithm>

namespace gridshell::render {
namespace {

constexpr double gap_mm = 2.5;  // between joint and arrow

}  // namespace

bool acts(const record::LoadedJoint& load, const record::Layout& layout,
          const record::Frame& frame) {
  if (!load.at_times || frame.reactions_N.cols() != Eigen::Index(layout.supports.size()))
    return true;
  const int node = layout.joints.at(std::size_t(load.joint)).node;
  const auto held = std::ranges::find(layout.supports, node);
  return held == layout.supports.end() ||
         !frame.reactions_N.col(held - layout.supports.begin()).isZero(0);
}

std::vector<LoadArrow> load_arrows(const record::Layout& layout, const record::Frame& frame) {
  std::vector<LoadArrow> arrows;
  if (layout.loaded_joints.empty() || layout.actuated_boundary.cols() == 0) return arrows;
  const double length = 0.25 * layout.length_scale_mm;
  const Eigen::Vector3d middle = layout.actuated_boundary.rowwise().mean();
  for (const record::LoadedJoint& load : layout.loaded_joints) {
    const int node = layout.joints.at(std::size_t(load.joint)).node;
    if (node >= frame.nodes.cols() || !acts(load, layout, frame)) continue;
    const Eigen::Vector3d at = frame.nodes.col(node);
    // clearly so: in a flat shell round-off must not choose
    const bool away = load.direction.dot(at - middle) > 0.02 * layout.length_scale_mm;
    const Eigen::Vector3d near = at + (away ? gap_mm : -gap_mm) * load.direction;
    const Eigen::Vector3d far = near + (away ? length : -length) * load.direction;
    arrows.push_back(away ? LoadArrow{node, near, far} : LoadArrow{node, far, near});
  }
  return arrows;
}

}  // namespace gridshell::render
