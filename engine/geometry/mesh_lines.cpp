#include "engine/geometry/mesh_lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/core/dense.h"
#include "engine/core/try.h"
#include "engine/geometry/surface.h"

namespace gridshell {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double sharp = 40 * degree, bent = 20 * degree;  // least crease angle: once, everywhere
constexpr double over_others = 3;  // least ratio of its angle to the median of those around

using Next = std::map<int, std::vector<int>>;

double length_of(const Eigen::Matrix3Xd& x, const std::vector<int>& line) {
  double length = 0;
  for (std::size_t k = 1; k < line.size(); ++k)
    length += (x.col(line[k]) - x.col(line[k - 1])).norm();
  return length;
}

/// The line from vertex `begin` over `to`, until it ends, closes or branches.
std::vector<int> followed(const Next& next, int begin, int to) {
  std::vector<int> line{begin, to};
  while (line.back() != begin && next.at(line.back()).size() == 2) {
    const auto& neighbours = next.at(line.back());
    line.push_back(neighbours[0] == line[line.size() - 2] ? neighbours[1] : neighbours[0]);
  }
  return line;
}

Result<std::vector<MeshLine>> rims_of(const Eigen::Matrix3Xd& x, const EdgeSides& sides) {
  Next next;
  for (const auto& [edge, triangles] : sides)
    if (triangles.size() == 1) {
      next[edge[0]].push_back(edge[1]);
      next[edge[1]].push_back(edge[0]);
    }
  std::vector<MeshLine> rims;
  std::set<int> seen;
  for (const auto& [begin, neighbours] : next) {
    if (neighbours.size() != 2)
      return mesh_error("two parts of the mesh touch in one vertex", x.col(begin));
    if (seen.contains(begin)) continue;
    rims.push_back({LineKind::hole, followed(next, begin, neighbours[0])});
    seen.insert(rims.back().vertices.begin(), rims.back().vertices.end());
  }
  if (!rims.empty())
    std::ranges::max_element(rims, {}, [&](const MeshLine& line) {
      return length_of(x, line.vertices);
    })->kind = LineKind::rim;
  return rims;
}

/// Angle between the normals of the two triangles at every inner edge, rad.
std::map<MeshEdge, double> turns_of(const Eigen::Matrix3Xd& x,
                                    const std::vector<std::array<int, 3>>& triangles,
                                    const EdgeSides& sides) {
  const auto normal = [&](int t) -> Eigen::Vector3d {
    const auto& [a, b, c] = triangles[std::size_t(t)];
    return (x.col(b) - x.col(a)).cross(x.col(c) - x.col(a));
  };
  std::map<MeshEdge, double> turns;
  for (const auto& [edge, both] : sides) {
    if (both.size() != 2) continue;
    turns[edge] = angle_between(normal(both[0]), normal(both[1]));
  }
  return turns;
}

std::vector<MeshLine> creases_of(const std::map<MeshEdge, double>& turns) {
  std::map<int, std::vector<double>> around;
  for (const auto& [edge, turn] : turns)
    for (const int end : edge) around[end].push_back(turn);
  for (auto& [vertex, all] : around) std::ranges::sort(all);
  // candidates, joined at their ends
  Next next;
  std::map<MeshEdge, double> taken;
  for (const auto& [edge, turn] : turns) {
    // median of the angles at the other edges of a vertex
    const auto median = [&](int end) {
      const auto& all = around[end];
      if (all.size() < 2) return 0.0;
      const std::size_t middle = (all.size() - 2) / 2;
      return all[all[middle] < turn ? middle : middle + 1];
    };
    if (turn < bent || turn < over_others * std::max(median(edge[0]), median(edge[1]))) continue;
    taken[edge] = turn;
    next[edge[0]].push_back(edge[1]);
    next[edge[1]].push_back(edge[0]);
  }
  std::vector<MeshLine> creases;
  std::set<MeshEdge> seen;
  const auto follow = [&](int begin) {
    for (const int to : next.at(begin)) {
      if (seen.contains({std::min(begin, to), std::max(begin, to)})) continue;
      MeshLine line{LineKind::crease, followed(next, begin, to)};
      double most = 0;
      for (std::size_t k = 1; k < line.vertices.size(); ++k) {
        const MeshEdge edge{std::min(line.vertices[k], line.vertices[k - 1]),
                            std::max(line.vertices[k], line.vertices[k - 1])};
        seen.insert(edge);
        most = std::max(most, taken.at(edge));
      }
      if (most >= sharp && line.vertices.size() > 2) creases.push_back(std::move(line));
    }
  };
  for (const auto& [begin, neighbours] : next)
    if (neighbours.size() != 2) follow(begin);
  for (const auto& [begin, neighbours] : next) follow(begin);
  return creases;
}

}  // namespace

Result<std::vector<MeshLine>> lines_of(const Eigen::Matrix3Xd& vertices,
                                       const std::vector<std::array<int, 3>>& triangles,
                                       const EdgeSides& sides) {
  TRY(lines, rims_of(vertices, sides));
  for (MeshLine& crease : creases_of(turns_of(vertices, triangles, sides)))
    lines->push_back(std::move(crease));
  return std::move(*lines);
}

Barriers::Barriers(const TriangleMesh& mesh)
    : height_(mesh.mean_edge()), near_(2 * mesh.mean_edge()) {
  constexpr std::size_t most_entries = 10000000;
  constexpr double longer = 0.01;  // walls overlap, so that no path passes between two of them
  const auto& x = mesh.vertices();
  std::map<int, int> ends;
  for (const MeshLine& line : mesh.lines()) {
    if (line.kind == LineKind::crease) {
      has_creases_ = true;
      ++ends[line.vertices.front()], ++ends[line.vertices.back()];
    }
    for (std::size_t k = 1; k < line.vertices.size(); ++k) {
      const int a = line.vertices[k - 1], b = line.vertices[k];
      const Eigen::Vector3d along = x.col(b) - x.col(a);
      Eigen::Vector3d normal = mesh.normals().col(a) + mesh.normals().col(b);
      normal -= normal.dot(along) / along.squaredNorm() * along;
      walls_.push_back(
          {x.col(a) - longer * along, (1 + 2 * longer) * along, normal.normalized(), line.kind});
      Eigen::AlignedBox3d box;
      for (const double t : {0.0, 1.0})
        for (const double side : {-height_, height_})
          box.extend(
              Eigen::Vector3d(walls_.back().begin + t * along + side * walls_.back().normal));
      near_.add(int(walls_.size()) - 1, box, most_entries);
    }
  }
  for (const auto& [vertex, count] : ends)
    if (count == 1 && !mesh.on_rim(vertex)) tips_.emplace_back(x.col(vertex));
}

std::optional<LineKind> Barriers::crossing(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                                           bool creases_alone) const {
  if (walls_.empty()) return std::nullopt;
  const Eigen::Vector3d edge = q - p;
  // cells of two mean edges along the path
  const int steps = std::max(1, int(std::ceil(2 * edge.norm() / height_)));
  const std::vector<int>* before = nullptr;
  for (int k = 0; k <= steps; ++k) {
    const auto* near = near_.at(p + double(k) / steps * edge);
    if (!near || near == before) continue;
    before = near;
    for (const int number : *near) {
      const Wall& wall = walls_[std::size_t(number)];
      if (creases_alone && wall.kind != LineKind::crease) continue;
      const Eigen::Vector3d across = wall.normal.cross(wall.along);
      const double from = across.dot(p - wall.begin), to = across.dot(q - wall.begin);
      if ((from < 0) == (to < 0)) continue;
      const Eigen::Vector3d at = p + from / (from - to) * edge - wall.begin;
      const double along = wall.along.dot(at) / wall.along.squaredNorm();
      if (along >= 0 && along <= 1 && std::abs(wall.normal.dot(at)) <= height_) return wall.kind;
    }
  }
  return std::nullopt;
}

}  // namespace gridshell
