#include "engine/scene/load_case.h"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "engine/core/try.h"
#include "engine/scene/scene.h"

namespace gridshell {
namespace {

/// The net as a planar graph.
struct Graph {
  Eigen::Matrix3Xd positions;                // positions of nodes in the flat, mm
  std::vector<std::vector<int>> neighbours;  // the nodes around each, anticlockwise

  explicit Graph(const Footprint& footprint) {
    const std::size_t joints = footprint.joints.size(), rods = footprint.rods.size();
    positions.setZero(3, Eigen::Index(joints + 2 * rods));
    neighbours.resize(joints + 2 * rods);
    for (std::size_t k = 0; k < joints; ++k)
      positions.col(Eigen::Index(k)).head<2>() << footprint.joints[k].u, footprint.joints[k].v;
    for (std::size_t r = 0; r < rods; ++r) lay(footprint.rods[r], int(joints + 2 * r));
    for (std::size_t node = 0; node < neighbours.size(); ++node) sort_around(int(node));
  }

 private:
  void lay(const FootprintRod& rod, int begin) {
    std::vector<int> nodes = rod.joints;
    positions.col(begin).head<2>() = rod.at(rod.span.begin);
    positions.col(begin + 1).head<2>() = rod.at(rod.span.end);
    if (!rod.closed() && rod.begin != RodEnd::joined) nodes.insert(nodes.begin(), begin);
    if (!rod.closed() && rod.end != RodEnd::joined) nodes.push_back(begin + 1);
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      neighbours[std::size_t(nodes[k - 1])].push_back(nodes[k]);
      neighbours[std::size_t(nodes[k])].push_back(nodes[k - 1]);
    }
  }

  void sort_around(int node) {
    std::ranges::sort(neighbours[std::size_t(node)], {}, [&](int other) {
      const Eigen::Vector3d edge = positions.col(other) - positions.col(node);
      return std::atan2(edge.y(), edge.x());
    });
  }
};

/// The nodes of the face to the left of the edge from a to b, back to a.
std::vector<int> walk(const Graph& graph, int a, int b, std::set<std::pair<int, int>>& walked) {
  std::vector<int> chain;
  while (walked.insert({a, b}).second) {
    chain.push_back(a);
    const std::vector<int>& around = graph.neighbours[std::size_t(b)];
    const auto back = std::ranges::find(around, a);
    a = std::exchange(b, *(back == around.begin() ? around.end() - 1 : back - 1));
  }
  return chain;
}

using FaceSide = std::array<int, 2>;

FaceSide side_of(const Face& face, std::size_t k) {
  return {face.corners[k], face.corners[(k + 1) % face.corners.size()]};
}

/// The sides that belong to one face only, in the order of that face.
std::set<FaceSide> edge_of(const std::vector<Face>& faces) {
  std::set<FaceSide> edge;
  for (const Face& face : faces)
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const FaceSide side = side_of(face, k);
      if (!edge.erase({side[1], side[0]})) edge.insert(side);
    }
  return edge;
}

Eigen::Vector3d edge_direction(preset::EdgeDirection direction, const Eigen::Vector3d& normal,
                               const Eigen::Vector3d& side) {
  switch (direction) {
    case preset::EdgeDirection::down:
    case preset::EdgeDirection::pressure:  // not used: it has an energy instead
      break;
    case preset::EdgeDirection::normal:
      return -normal;
    case preset::EdgeDirection::inward:
      return normal.cross(side).normalized();
  }
  return -Eigen::Vector3d::UnitZ();
}

/// Adds the pressure on a face, as triangles: its energy is -p/3 A . c with A = 1/2 sum of x_k x
/// x_(k+1) and the mean c of its corners.
void add_pressure(const Face& face, double pressure, std::vector<NodeAction>& actions) {
  const std::size_t corners = face.corners.size();
  for (std::size_t k = 0; k < corners; ++k) {
    const auto [a, b] = side_of(face, k);
    for (const int corner : face.corners) {
      if (corner == a || corner == b) continue;
      actions.push_back(
          {.node = corner, .pressure = -pressure / double(corners), .corners = {a, b}});
    }
  }
}

Result<void> check_pressure(const LoadCase& load, const std::string& key,
                            const Footprint& footprint) {
  if (load.pressure_N_mm2 == 0) return {};
  std::set<int> fixed(footprint.fixed_joints.begin(), footprint.fixed_joints.end());
  const int joints = int(footprint.joints.size());
  for (std::size_t r = 0; r < footprint.rods.size(); ++r) {
    if (is_fixed(footprint.rods[r].begin)) fixed.insert(joints + 2 * int(r));
    if (is_fixed(footprint.rods[r].end)) fixed.insert(joints + 2 * int(r) + 1);
  }
  for (const FaceSide& side : edge_of(faces_of(footprint)))
    for (const int node : side) {
      if (fixed.contains(node)) continue;
      const std::string where =
          node < joints ? fmt::format("joint [{}, {}]", footprint.joints[std::size_t(node)].i,
                                      footprint.joints[std::size_t(node)].j)
                        : fmt::format("end of rod {}", (node - joints) / 2);
      return invalid(
          "{} pressure: got a free {} at the edge of the faces, expected a fixed edge: such a "
          "load has no energy; one on the edge has, edge_direction = \"pressure\"",
          key, where);
    }
  return {};
}

/// Direction to the half of the shell with snow; zero: all of it.
Eigen::Vector2d side_of(preset::SnowSide side) {
  switch (side) {
    case preset::SnowSide::x:
      return {1, 0};
    case preset::SnowSide::minus_x:
      return {-1, 0};
    case preset::SnowSide::y:
      return {0, 1};
    case preset::SnowSide::minus_y:
      return {0, -1};
    case preset::SnowSide::all:
      break;
  }
  return {0, 0};
}

}  // namespace

std::vector<Face> faces_of(const Footprint& footprint) {
  const Graph graph(footprint);
  std::vector<Face> faces;
  const auto keep = [&](std::vector<int> corners, bool on_boundary) {
    Face face{std::move(corners), on_boundary};
    // the outside is traversed clockwise; a chain without area is no face
    const double least = 1e-9 * footprint.spacing * footprint.spacing;
    if (area_of(face, graph.positions).z() > least) faces.push_back(std::move(face));
  };
  const auto is_edge_point = [&](int node) { return node >= int(footprint.joints.size()); };
  std::set<std::pair<int, int>> walked;
  for (int a = 0; a < int(graph.neighbours.size()); ++a)
    for (const int b : graph.neighbours[std::size_t(a)]) {
      std::vector<int> chain = walk(graph, a, b, walked);
      const auto first = std::ranges::find_if(chain, is_edge_point);
      if (chain.empty()) continue;
      if (first == chain.end()) {
        keep(chain, false);
        continue;
      }
      std::rotate(chain.begin(), first, chain.end());
      chain.push_back(chain.front());
      for (std::size_t from = 0, k = 1; k < chain.size(); ++k) {
        if (!is_edge_point(chain[k])) continue;
        keep({chain.begin() + std::ptrdiff_t(from), chain.begin() + std::ptrdiff_t(k) + 1}, true);
        from = k;
      }
    }
  return faces;
}

Eigen::Vector3d area_of(const Face& face, const Eigen::Matrix3Xd& nodes) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d origin = nodes.col(face.corners.front());
  for (std::size_t k = 2; k < face.corners.size(); ++k)
    sum += 0.5 * (nodes.col(face.corners[k - 1]) - origin)
                     .cross(Eigen::Vector3d(nodes.col(face.corners[k]) - origin));
  return sum;
}

std::vector<NodeAction> forces_of(const LoadCase& load, const Footprint& footprint,
                                  const Eigen::Matrix3Xd& nodes) {
  std::map<int, Eigen::Vector3d> forces;
  const auto add = [&](int node, const Eigen::Vector3d& force) {
    forces.try_emplace(node, Eigen::Vector3d::Zero()).first->second += force;
  };
  const Eigen::Vector2d middle =
      nodes.leftCols(Eigen::Index(footprint.joints.size())).topRows<2>().rowwise().mean();
  // half for a corner between a side with snow and one without
  const auto snowed = [&](int corner) {
    const double along = load.snow_side.dot(nodes.col(corner).head<2>() - middle);
    if (load.snow_side.isZero(0) || along > 1e-3 * footprint.spacing) return 1.0;
    return along < -1e-3 * footprint.spacing ? 0 : 0.5;
  };
  const Eigen::Vector3d wind(std::cos(load.wind_rad), std::sin(load.wind_rad), 0);
  const std::vector<Face> faces = faces_of(footprint);
  const bool at_edge = load.edge_N_mm != 0 || load.pressure_N_mm2 != 0;
  const std::set<FaceSide> edge = at_edge ? edge_of(faces) : std::set<FaceSide>();
  std::vector<NodeAction> actions;
  for (const Face& face : faces) {
    const Eigen::Vector3d area = area_of(face, nodes);
    if (load.pressure_N_mm2 != 0) add_pressure(face, load.pressure_N_mm2, actions);
    if (area.isZero(0)) continue;
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const FaceSide ends = side_of(face, k);
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
                         .corners = {ends[1], -1}});
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

namespace {

/// The node of a network's free end by the number of its point; -1: there is none.
int free_end_at(const Footprint& footprint, int point) {
  for (std::size_t end = 0; end < footprint.end_points.size(); ++end) {
    const FootprintRod& rod = footprint.rods[end / 2];
    if (footprint.end_points[end] == point && (end % 2 == 0 ? rod.begin : rod.end) == RodEnd::free)
      return int(footprint.joints.size() + end);
  }
  return -1;
}

}  // namespace

Result<std::vector<PointLoad>> points_of(const preset::Points& rows, const std::string& key,
                                         const Footprint& footprint) {
  std::vector<PointLoad> points;
  for (const auto& row : rows) {
    const int i = int(std::lround(row[0])), j = int(std::lround(row[1]));
    const bool whole = row[0] == i && row[1] == j;
    int joint = whole ? joint_at(footprint, i, j) : -1;
    if (joint < 0 && whole && j == 0) joint = free_end_at(footprint, i);
    if (joint < 0)
      return invalid(
          "{} points: got [{:g}, {:g}], which is no joint{}, expected one of the footprint's {}{}",
          key, row[0], row[1], footprint.end_points.empty() ? "" : " or free end",
          footprint.joints.size(),
          footprint.joints.empty()
              ? ""
              : fmt::format(", as [{}, {}]", footprint.joints[0].i, footprint.joints[0].j));
    points.push_back({joint, {row[2], row[3], row[4]}});
  }
  return points;
}

Result<std::vector<LoadCase>> load_cases_of(const preset::Preset& preset,
                                            const Footprint& footprint) {
  const preset::Loads& loads = preset.loads;
  std::vector<LoadCase> cases;
  for (std::size_t k = 0; k < preset.load_case.size(); ++k) {
    const preset::LoadCase& one = preset.load_case[k];
    const auto key = fmt::format("[[loads.case]] {}", k + 1);
    TRY(forces, points_of(one.points, key, footprint));
    cases.push_back({one.name, one.dead, 1e-6 * one.snow * loads.snow_N_m2,
                     1e-6 * one.wind * loads.wind_N_m2,
                     one.wind_deg.value_or(loads.wind_deg) * M_PI / 180, side_of(one.snow_side),
                     1e-3 * one.edge * loads.edge_N_m, loads.edge_direction,
                     1e-6 * one.pressure * loads.pressure_N_m2, std::move(*forces)});
    TRY_DO(check_pressure(cases.back(), key, footprint));
  }
  return cases;
}

}  // namespace gridshell
