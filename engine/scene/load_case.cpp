#include "engine/scene/load_case.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/footprint/faces.h"

namespace gridshell {
namespace {

Eigen::Vector2d middle_of(const std::vector<int>& corners, const Eigen::Matrix3Xd& nodes) {
  Eigen::Vector2d sum{0, 0};
  for (const int corner : corners) sum += nodes.col(corner).head<2>();
  return sum / double(corners.size());
}

}  // namespace

std::vector<NodeAction> forces_of(const LoadCase& load, const Footprint& footprint,
                                  const Eigen::Matrix3Xd& nodes) {
  std::map<int, Eigen::Vector3d> forces;
  const auto add = [&](int node, const Eigen::Vector3d& force) {
    forces.try_emplace(node, Eigen::Vector3d::Zero()).first->second += force;
  };
  const Eigen::Vector2d middle =
      nodes.leftCols(Eigen::Index(footprint.joints.size())).topRows<2>().rowwise().mean();
  const Eigen::Vector3d wind(std::cos(load.wind_rad), std::sin(load.wind_rad), 0);
  for (const Face& face : faces_of(footprint)) {
    const Eigen::Vector3d area = area_of(face, nodes);
    if (area.isZero(0)) continue;
    Eigen::Vector3d force = load.wind_N_mm2 * wind.dot(area.normalized()) * area;
    if (load.snow_side.dot(middle_of(face.corners, nodes) - middle) >= 0)
      force.z() -= load.snow_N_mm2 * std::max(area.z(), 0.0);
    for (const int corner : face.corners) add(corner, force / double(face.corners.size()));
  }
  for (const PointLoad& point : load.points) add(point.joint, point.force);
  std::vector<NodeAction> actions;
  for (const auto& [node, force] : forces)
    if (!force.isZero(0)) actions.push_back({node, force});
  return actions;
}

}  // namespace gridshell
