#include "render/movie/load_marks.h"

namespace gridshell::render {
namespace {

constexpr double gap_mm = 2.5;  // between joint and arrow

}  // namespace

std::vector<LoadArrow> load_arrows(const record::Layout& layout, const record::Frame& frame) {
  std::vector<LoadArrow> arrows;
  if (layout.loaded_joints.empty() || layout.actuated_boundary.cols() == 0) return arrows;
  const double length = 0.25 * layout.length_scale_mm;
  const Eigen::Vector3d middle = layout.actuated_boundary.rowwise().mean();
  for (const record::LoadedJoint& load : layout.loaded_joints) {
    const int node = layout.joints.at(std::size_t(load.joint)).node;
    if (node >= frame.nodes.cols()) continue;
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
