// Lines of a triangle mesh that no rod crosses: its rim, its holes and its creases.
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "engine/core/proximity.h"
#include "engine/core/result.h"

namespace gridshell {

/// An edge of a mesh, the lower vertex first, and the triangles on it.
using MeshEdge = std::array<int, 2>;
using EdgeSides = std::map<MeshEdge, std::vector<int>>;

enum class LineKind : char { rim, hole, crease };

/// Vertices in order along a line; of a rim or a hole the last is the first again.
struct MeshLine {
  LineKind kind = LineKind::rim;
  std::vector<int> vertices;
};

/// The longest closed line of edges with one triangle is the rim, others are holes; creases are
/// chains of two or more edges at which the triangles turn by 40 degrees somewhere, by 20 all
/// along, and by three times as much as at the edges around. Errors (bad_input): two parts that
/// touch in one vertex.
Result<std::vector<MeshLine>> lines_of(const Eigen::Matrix3Xd& vertices,
                                       const std::vector<std::array<int, 3>>& triangles,
                                       const EdgeSides& sides);

class TriangleMesh;

/// These lines as walls upright on the surface, a mean edge of the mesh to each side of it.
class Barriers {
 public:
  Barriers() = default;
  explicit Barriers(const TriangleMesh& mesh);

  /// What the straight path from p to q crosses; nothing: it is free.
  std::optional<LineKind> crossed(const Eigen::Vector3d& p, const Eigen::Vector3d& q) const {
    return crossing(p, q, false);
  }
  bool crosses_crease(const Eigen::Vector3d& p, const Eigen::Vector3d& q) const {
    return has_creases_ && crossing(p, q, true).has_value();
  }
  bool has_creases() const { return has_creases_; }
  /// Where creases end within the surface.
  const std::vector<Eigen::Vector3d>& tips() const { return tips_; }

 private:
  struct Wall {
    Eigen::Vector3d begin, along, normal;
    LineKind kind;
  };
  std::optional<LineKind> crossing(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                                   bool creases_alone) const;

  double height_ = 1;  ///< of the walls, to each side
  bool has_creases_ = false;
  std::vector<Wall> walls_;
  std::vector<Eigen::Vector3d> tips_;
  BoxGrid near_{1};
};

}  // namespace gridshell
