#include "engine/scene/load_case.h"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "engine/footprint/faces.h"

namespace gridshell {
namespace {

using Side = std::array<int, 2>;

Side side_of(const Face& face, std::size_t k) {
  return {face.corners[k], face.corners[(k + 1) % face.corners.size()]};
}

/// The sides of faces that no other face shares, each in its face's order.
std::set<Side> edge_of(const std::vector<Face>& faces) {
  std::set<Side> edge;
  for (const Face& face : faces)
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const Side side = side_of(face, k);
      if (!edge.erase({side[1], side[0]})) edge.insert(side);
    }
  return edge;
}

Eigen::Vector3d edge_direction(preset::EdgeDirection direction, const Eigen::Vector3d& normal,
                               const Eigen::Vector3d& side) {
  switch (direction) {
    case preset::EdgeDirection::down:
    case preset::EdgeDirection::pressure:  // has an energy
      break;
    case preset::EdgeDirection::normal:
      return -normal;
    case preset::EdgeDirection::inward:
      return normal.cross(side).normalized();
  }
  return -Eigen::Vector3d::UnitZ();
}

/// 1/3 A . c of a face, A = 1/2 sum of x_k x x_(k+1), c the mean of its corners, as triangles.
void add_pressure(const Face& face, double pressure, std::vector<NodeAction>& actions) {
  const std::size_t corners = face.corners.size();
  for (std::size_t k = 0; k < corners; ++k) {
    const auto [a, b] = side_of(face, k);
    for (const int corner : face.corners) {
      if (corner == a || corner == b) continue;
      actions.push_back(
          {.node = corner, .pressure = -pressure / double(corners), .beside = {a, b}});
    }
  }
}

}  // namespace

Result<void> check_pressure(const LoadCase& load, const std::string& key,
                            const Footprint& footprint) {
  if (load.pressure_N_mm2 == 0) return {};
  std::set<int> held(footprint.held_joints.begin(), footprint.held_joints.end());
  const int joints = int(footprint.joints.size());
  for (std::size_t r = 0; r < footprint.rods.size(); ++r) {
    if (is_held(footprint.rods[r].begin)) held.insert(joints + 2 * int(r));
    if (is_held(footprint.rods[r].end)) held.insert(joints + 2 * int(r) + 1);
  }
  for (const Side& side : edge_of(faces_of(footprint)))
    for (const int node : side) {
      if (held.contains(node)) continue;
      const std::string place =
          node < joints ? fmt::format("joint [{}, {}]", footprint.joints[std::size_t(node)].i,
                                      footprint.joints[std::size_t(node)].j)
                        : fmt::format("an end of rod {}", (node - joints) / 2);
      return fail(Fault::bad_input,
                  "{} pressure: the edge of the faces must be held, and {} there is free: such a "
                  "load has no energy; one on the edge has, edge_direction = \"pressure\"",
                  key, place);
    }
  return {};
}

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
  const bool at_edge = load.edge_N_mm != 0 || load.pressure_N_mm2 != 0;
  const std::set<Side> edge = at_edge ? edge_of(faces) : std::set<Side>();
  std::vector<NodeAction> actions;
  for (const Face& face : faces) {
    const Eigen::Vector3d area = area_of(face, nodes);
    if (load.pressure_N_mm2 != 0) add_pressure(face, load.pressure_N_mm2, actions);
    if (area.isZero(0)) continue;
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const Side ends = side_of(face, k);
      if (!edge.contains(ends)) continue;
      const Eigen::Vector3d a = nodes.col(ends[0]), b = nodes.col(ends[1]), n = area.normalized();
      const bool turns = load.edge_direction == preset::EdgeDirection::pressure;
      const double dead = turns ? 0 : load.edge_N_mm, turning = turns ? load.edge_N_mm : 0;
      for (const int end : ends)
        add(end, 0.5 * dead * (b - a).norm() * edge_direction(load.edge_direction, n, b - a) -
                     load.pressure_N_mm2 / 6 * a.cross(b));
      actions.push_back({.node = ends[0],
                         .anchor = 3 * Eigen::Vector3d::UnitZ(),
                         .pressure = -turning,
                         .beside = {ends[1], -1}});
    }
    const Eigen::Vector3d wind_force = load.wind_N_mm2 * wind.dot(area.normalized()) * area;
    const double corners = double(face.corners.size());
    const double snow = load.snow_N_mm2 * std::max(area.z(), 0.0) / corners;
    for (const int corner : face.corners)
      add(corner, wind_force / corners - snow * snowed(corner) * Eigen::Vector3d::UnitZ());
  }
  for (const PointLoad& point : load.points) add(point.joint, point.force);
  for (const auto& [node, force] : forces) actions.push_back({node, force});
  std::erase_if(actions, [](const NodeAction& action) { return action.is_none(); });
  return actions;
}

}  // namespace gridshell
