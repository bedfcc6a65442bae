#include "engine/geometry/surface.h"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/proximity.h"
#include "engine/core/try.h"
#include "engine/geometry/triangles.h"

namespace gridshell {
namespace {

using Triangle = std::array<int, 3>;

/// The point where the segment from a to b meets a triangle [Moeller, Trumbore 1997]; empty: none.
std::optional<Eigen::Vector3d> meeting(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                       const Eigen::Matrix3Xd& x, const Triangle& triangle) {
  constexpr double parallel = 1e-12;
  const Eigen::Vector3d ray = b - a, p = x.col(triangle[0]), e = x.col(triangle[1]) - p,
                        f = x.col(triangle[2]) - p, across = ray.cross(f), off = a - p;
  const double volume = e.dot(across);
  if (std::abs(volume) <= parallel * ray.norm() * e.norm() * f.norm()) return std::nullopt;
  const Eigen::Vector3d q = off.cross(e);
  const double u = off.dot(across) / volume, v = ray.dot(q) / volume, t = f.dot(q) / volume;
  if (u < 0 || v < 0 || u + v > 1 || t < 0 || t > 1) return std::nullopt;
  return a + t * ray;
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

using Triangles = TriangleMesh::Triangles;

using Edge = MeshEdge;
using Sides = EdgeSides;

bool runs_along(const std::array<int, 3>& triangle, const Edge& edge) {
  for (std::size_t k = 0; k < 3; ++k)
    if (triangle[k] == edge[0]) return triangle[(k + 1) % 3] == edge[1];
  return false;
}

/// The vertices that triangles use; the triangles are changed to their new indices.
Result<Eigen::Matrix3Xd> used_vertices(const Eigen::Matrix3Xd& all, Triangles& triangles) {
  std::vector<int> new_numbers(std::size_t(all.cols()), -1);
  std::vector<int> used;
  for (auto& triangle : triangles)
    for (int& corner : triangle) {
      if (corner < 0 || corner >= all.cols())
        return invalid("got vertex {} in a triangle, expected one of {}", corner, all.cols());
      int& number = new_numbers[std::size_t(corner)];
      if (number < 0) {
        number = int(used.size());
        used.push_back(corner);
      }
      corner = number;
    }
  return Eigen::Matrix3Xd(all(Eigen::all, used));
}

/// The triangles at each edge. Errors: an edge with three triangles, a triangle without area.
Result<Sides> sides_of(const Eigen::Matrix3Xd& x, const Triangles& triangles) {
  constexpr double thin = 1e-9;  // area over the square of the longest edge
  Sides sides;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
      const Edge edge = edge_of(triangles[t], k);
      longest = std::max(longest, (x.col(edge[1]) - x.col(edge[0])).norm());
      auto& at_edge = sides[edge];
      at_edge.push_back(int(t));
      if (at_edge.size() > 2)
        return mesh_error("three triangles of the mesh share an edge", x.col(edge[0]));
    }
    if (!(area_of(x, triangles[t]).norm() > thin * longest * longest))
      return mesh_error("a triangle of the mesh has no area", x.col(triangles[t][0]));
  }
  return sides;
}

/// Orients all triangles as the first one. Errors: a surface with one side, several pieces.
Result<void> turn_alike(const Eigen::Matrix3Xd& x, const Sides& sides, Triangles& triangles) {
  std::vector<char> done(triangles.size(), 0);
  std::vector<int> open{0};
  done[0] = 1;
  std::size_t reached = 0;
  while (!open.empty()) {
    const int current = open.back();
    open.pop_back();
    ++reached;
    for (int k = 0; k < 3; ++k) {
      const Edge edge = edge_of(triangles[std::size_t(current)], k);
      for (const int neighbour : sides.at(edge)) {
        if (neighbour == current) continue;
        auto& other = triangles[std::size_t(neighbour)];
        const bool consistent =
            runs_along(other, edge) != runs_along(triangles[std::size_t(current)], edge);
        if (done[std::size_t(neighbour)] && !consistent)
          return mesh_error("the mesh has one side only, as a Moebius strip,", x.col(edge[0]));
        if (done[std::size_t(neighbour)]) continue;
        if (!consistent) std::swap(other[1], other[2]);
        done[std::size_t(neighbour)] = 1;
        open.push_back(neighbour);
      }
    }
  }
  if (reached == triangles.size()) return {};
  const auto unreached = std::size_t(std::ranges::find(done, 0) - done.begin());
  return mesh_error(
      fmt::format("the mesh is in several pieces ({} of its {} triangles hang together): "
                  "another begins",
                  reached, triangles.size()),
      x.col(triangles[unreached][0]));
}

/// Checks that no two neighbouring triangles enclose an angle below 30 degrees.
Result<void> check_folds(const Eigen::Matrix3Xd& x, const Sides& sides,
                         const Triangles& triangles) {
  constexpr double folded = -0.87;  // cosine between the normals: more than 150 degrees
  for (const auto& [edge, both] : sides) {
    if (both.size() < 2) continue;
    const Eigen::Vector3d a = area_of(x, triangles[std::size_t(both[0])]),
                          b = area_of(x, triangles[std::size_t(both[1])]);
    if (a.dot(b) < folded * a.norm() * b.norm())
      return mesh_error("the mesh is folded", x.col(edge[0]));
  }
  return {};
}

}  // namespace

Result<std::optional<Eigen::Vector3d>> first_crossing(const Eigen::Matrix3Xd& vertices,
                                                      const std::vector<Triangle>& triangles,
                                                      double size) {
  constexpr std::size_t most_entries = 8000000, most_pairs = 50000000;
  std::vector<Eigen::AlignedBox3d> boxes;
  BoxGrid grid(2 * size);
  const auto too_long = [](const char* why) {
    return invalid("the mesh cannot be looked through: {}", why);
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
        if (++pairs > most_pairs) return too_long("too many triangles lie at one position");
        const std::size_t s = std::size_t(inside[a]), t = std::size_t(inside[b]);
        if (apart(boxes[s], boxes[t]) || share_a_vertex(triangles[s], triangles[t])) continue;
        if (const auto at = meeting(vertices, triangles[s], triangles[t]))
          return std::optional<Eigen::Vector3d>(*at);
      }
  return std::optional<Eigen::Vector3d>();
}

tl::unexpected<Error> mesh_error(const std::string& what, const Eigen::Vector3d& p) {
  return invalid("{} near ({:.4g}, {:.4g}, {:.4g}) mm", what, p.x(), p.y(), p.z());
}

Result<TriangleMesh> TriangleMesh::make(const Eigen::Matrix3Xd& vertices, Triangles triangles) {
  if (triangles.empty()) return invalid("got a mesh without a triangle");
  if (!vertices.allFinite()) return invalid("got a vertex that is not finite");
  TRY(used, used_vertices(vertices, triangles));
  const Eigen::Matrix3Xd& x = *used;
  TRY(sides, sides_of(x, triangles));
  TRY_DO(turn_alike(x, *sides, triangles));
  TRY_DO(check_folds(x, *sides, triangles));
  TriangleMesh mesh;
  TRY(lines, lines_of(x, triangles, *sides));
  mesh.lines_ = std::move(*lines);
  mesh.on_crease_.assign(std::size_t(x.cols()), 0);
  for (const MeshLine& line : mesh.lines_)
    if (line.kind == LineKind::crease)
      for (const int vertex : line.vertices) mesh.on_crease_[std::size_t(vertex)] = 1;
  mesh.neighbours_.resize(std::size_t(x.cols()));
  mesh.on_rim_.assign(std::size_t(x.cols()), 0);
  mesh.longest_.assign(std::size_t(x.cols()), 0);
  for (const auto& [edge, on_it] : *sides) {
    const auto [a, b] = edge;
    if (on_it.size() == 1) mesh.on_rim_[std::size_t(a)] = mesh.on_rim_[std::size_t(b)] = 1;
    mesh.neighbours_[std::size_t(a)].push_back(b);
    mesh.neighbours_[std::size_t(b)].push_back(a);
    const double length = (x.col(b) - x.col(a)).norm();
    for (const int end : edge)
      mesh.longest_[std::size_t(end)] = std::max(mesh.longest_[std::size_t(end)], length);
    mesh.mean_edge_ += length / double(sides->size());
  }
  mesh.normals_ = Eigen::Matrix3Xd::Zero(3, x.cols());
  for (const auto& triangle : triangles)
    for (const int corner : triangle) mesh.normals_.col(corner) += area_of(x, triangle);
  for (auto normal : mesh.normals_.colwise()) normal.normalize();
  TRY(crossing, first_crossing(x, triangles, mesh.mean_edge_));
  if (*crossing) return mesh_error("the mesh runs through itself", **crossing);
  mesh.vertices_ = std::move(*used);
  mesh.triangles_ = std::move(triangles);
  return mesh;
}

double TriangleMesh::area() const {
  double sum = 0;
  for (const auto& triangle : triangles_) sum += area_of(vertices_, triangle).norm();
  return sum;
}

double TriangleMesh::size() const {
  return (vertices_.rowwise().maxCoeff() - vertices_.rowwise().minCoeff()).maxCoeff();
}

}  // namespace gridshell
