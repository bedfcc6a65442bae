#include "engine/geometry/triangle_crossing.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "engine/geometry/box_grid.h"

namespace gridshell {
namespace {

using Triangle = std::array<int, 3>;

/// Where the segment from a to b meets a triangle [Moeller, Trumbore 1997].
std::optional<Eigen::Vector3d> meeting(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                       const Eigen::Matrix3Xd& x, const Triangle& triangle) {
  constexpr double parallel = 1e-12;
  const Eigen::Vector3d way = b - a, p = x.col(triangle[0]), e = x.col(triangle[1]) - p,
                        f = x.col(triangle[2]) - p, across = way.cross(f), off = a - p;
  const double volume = e.dot(across);
  if (std::abs(volume) <= parallel * way.norm() * e.norm() * f.norm()) return std::nullopt;
  const Eigen::Vector3d q = off.cross(e);
  const double u = off.dot(across) / volume, v = way.dot(q) / volume, t = f.dot(q) / volume;
  if (u < 0 || v < 0 || u + v > 1 || t < 0 || t > 1) return std::nullopt;
  return a + t * way;
}

std::optional<Eigen::Vector3d> meeting(const Eigen::Matrix3Xd& x, const Triangle& one,
                                       const Triangle& other) {
  for (const auto& [edges, face] : {std::pair(&one, &other), {&other, &one}})
    for (std::size_t k = 0; k < 3; ++k)
      if (auto at = meeting(x.col((*edges)[k]), x.col((*edges)[(k + 1) % 3]), x, *face)) return at;
  return std::nullopt;
}

bool share_a_vertex(const Triangle& one, const Triangle& other) {
  return std::ranges::any_of(one,
                             [&](int k) { return std::ranges::find(other, k) != other.end(); });
}

bool apart(const Eigen::AlignedBox3d& one, const Eigen::AlignedBox3d& other) {
  return !one.intersects(other);
}

}  // namespace

Result<std::optional<Eigen::Vector3d>> first_crossing(const Eigen::Matrix3Xd& vertices,
                                                      const std::vector<Triangle>& triangles,
                                                      double size) {
  constexpr std::size_t most_entries = 8000000, most_pairs = 50000000;
  std::vector<Eigen::AlignedBox3d> boxes;
  BoxGrid grid(2 * size);
  const auto too_long = [](const char* why) {
    return fail(Fault::bad_input, fmt::format("the mesh cannot be looked through: {}", why));
  };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Eigen::AlignedBox3d box;
    for (const int corner : triangles[t]) box.extend(vertices.col(corner));
    boxes.push_back(box);
    if (!grid.add(int(t), box, most_entries))
      return too_long("its triangles are too uneven in size");
  }
  std::size_t pairs = 0;
  for (const auto& [cell, inside] : grid.cells())
    for (std::size_t a = 0; a < inside.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) {
        if (++pairs > most_pairs) return too_long("too many triangles lie in one place");
        const std::size_t s = std::size_t(inside[a]), t = std::size_t(inside[b]);
        if (apart(boxes[s], boxes[t]) || share_a_vertex(triangles[s], triangles[t])) continue;
        if (const auto at = meeting(vertices, triangles[s], triangles[t]))
          return std::optional<Eigen::Vector3d>(*at);
      }
  return std::optional<Eigen::Vector3d>();
}

}  // namespace gridshell
