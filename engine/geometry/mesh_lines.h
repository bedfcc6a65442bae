// Lines of a triangle mesh that rods must not cross: its rim, its holes and its creases.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "engine/core/proximity.h"
#include "engine/core/result.h"

namespace gridshell {

/// An edge of a mesh as its two vertices, the lower index first.
using MeshEdge = std::array<int, 2>;
/// The triangles at each edge.
using EdgeSides = std::map<MeshEdge, std::vector<int>>;

enum class LineKind : char { rim, hole, crease };

/// A line as its vertices in order; in a rim or a hole the last vertex is the first again.
struct MeshLine {
  LineKind kind = LineKind::rim;
  std::vector<int> vertices;
};

/// Finds the lines of a mesh. The longest closed line of edges with one triangle is the rim, the
/// others are holes. Creases are chains of at least two edges: the angle between the normals of the
/// two triangles is at least 40 degrees at one edge, at least 20 degrees at all edges, and at least
/// three times that at the edges around. Errors (bad_input): two parts that touch in one vertex.
Result<std::vector<MeshLine>> lines_of(const Eigen::Matrix3Xd& vertices,
                                       const std::vector<std::array<int, 3>>& triangles,
                                       const EdgeSides& sides);

class TriangleMesh;

/// The lines as walls perpendicular to the surface, which reach a mean edge of the mesh to each
/// side.
class Barriers {
 public:
  Barriers() = default;
  explicit Barriers(const TriangleMesh& mesh);

  /// Kind of the line that the straight path from p to q crosses; empty: it crosses none.
  std::optional<LineKind> crossed(const Eigen::Vector3d& p, const Eigen::Vector3d& q) const {
    return crossing(p, q, false);
  }
  bool crosses_crease(const Eigen::Vector3d& p, const Eigen::Vector3d& q) const {
    return has_creases_ && crossing(p, q, true).has_value();
  }
  /// Positions where creases end inside the surface.
  const std::vector<Eigen::Vector3d>& tips() const { return tips_; }

 private:
  struct Wall {
    Eigen::Vector3d begin, along, normal;
    LineKind kind;
  };
  std::optional<LineKind> crossing(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                                   bool creases_alone) const;

  double height_ = 1;  ///< height of the walls to each side of the surface
  bool has_creases_ = false;
  std::vector<Wall> walls_;
  std::vector<Eigen::Vector3d> tips_;
  BoxGrid near_{1};
};

}  // namespace gridshell
