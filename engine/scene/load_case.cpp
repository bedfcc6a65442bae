#include "engine/scene/load_case.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "engine/footprint/faces.h"

namespace gridshell {
namespace {

/// All sides of faces, each in its face's order.
std::set<std::array<int, 2>> sides_of(const std::vector<Face>& faces) {
  std::set<std::array<int, 2>> sides;
  for (const Face& face : faces)
    for (std::size_t k = 0; k < face.corners.size(); ++k)
      sides.insert({face.corners[k], face.corners[(k + 1) % face.corners.size()]});
  return sides;
}

Eigen::Vector3d edge_direction(preset::EdgeDirection direction, const Eigen::Vector3d& normal,
                               const Eigen::Vector3d& side) {
  switch (direction) {
    case preset::EdgeDirection::down:
      break;
    case preset::EdgeDirection::normal:
      return -normal;
    case preset::EdgeDirection::inward:
      return normal.cross(side).normalized();
  }
  return -Eigen::Vector3d::UnitZ();
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
  // of a corner half way between the sides half
  const auto snowed = [&](int corner) {
    const double along = load.snow_side.dot(nodes.col(corner).head<2>() - middle);
    if (load.snow_side.isZero(0) || along > 1e-3 * footprint.spacing) return 1.0;
    return along < -1e-3 * footprint.spacing ? 0 : 0.5;
  };
  const Eigen::Vector3d wind(std::cos(load.wind_rad), std::sin(load.wind_rad), 0);
  const std::vector<Face> faces = faces_of(footprint);
  const auto sides = load.edge_N_mm != 0 ? sides_of(faces) : std::set<std::array<int, 2>>();
  for (const Face& face : faces) {
    const Eigen::Vector3d area = area_of(face, nodes);
    if (area.isZero(0)) continue;
    for (std::size_t k = 0; load.edge_N_mm != 0 && k < face.corners.size(); ++k) {
      const int a = face.corners[k], b = face.corners[(k + 1) % face.corners.size()];
      if (sides.contains({b, a})) continue;
      const Eigen::Vector3d side = nodes.col(b) - nodes.col(a), n = area.normalized();
      const Eigen::Vector3d along = edge_direction(load.edge_direction, n, side);
      for (const int end : {a, b}) add(end, 0.5 * load.edge_N_mm * side.norm() * along);
    }
    const Eigen::Vector3d wind_force = load.wind_N_mm2 * wind.dot(area.normalized()) * area;
    const double corners = double(face.corners.size());
    const double snow = load.snow_N_mm2 * std::max(area.z(), 0.0) / corners;
    for (const int corner : face.corners)
      add(corner, wind_force / corners - snow * snowed(corner) * Eigen::Vector3d::UnitZ());
  }
  for (const PointLoad& point : load.points) add(point.joint, point.force);
  std::vector<NodeAction> actions;
  for (const auto& [node, force] : forces)
    if (!force.isZero(0)) actions.push_back({node, force});
  return actions;
}

}  // namespace gridshell
