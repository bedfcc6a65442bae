// Whether triangles run through one another.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace gridshell {

/// A point where two triangles without a common vertex meet; nothing: there is none. They are
/// looked for among boxes of about `size`, mm. Errors (bad_input): triangles so uneven in size, or
/// so many in one place, that it would take too long.
Result<std::optional<Eigen::Vector3d>> first_crossing(
    const Eigen::Matrix3Xd& vertices, const std::vector<std::array<int, 3>>& triangles,
    double size);

// A mesh of triangles that is a surface.

/// What is wrong with a mesh, with the place.
tl::unexpected<Error> mesh_fault(const std::string& what, const Eigen::Vector3d& place);

/// One connected, two-sided sheet of triangles, all turned the same way, with one rim or none, that
/// neither folds nor meets itself.
class TriangleMesh {
 public:
  using Triangles = std::vector<std::array<int, 3>>;

  /// Vertices that no triangle has are left out. Errors (bad_input), with the place: a triangle of
  /// no area, an edge of three triangles, several pieces, a hole (more than one rim), a mesh of one
  /// side, neighbours folded onto one another, triangles that meet elsewhere than at their edges, a
  /// number of a vertex that is not there.
  static Result<TriangleMesh> make(const Eigen::Matrix3Xd& vertices, Triangles triangles);

  const Eigen::Matrix3Xd& vertices() const { return vertices_; }
  const Triangles& triangles() const { return triangles_; }
  const Eigen::Matrix3Xd& normals() const { return normals_; }  ///< of the vertices, unit
  /// Vertices joined to each by an edge.
  const std::vector<std::vector<int>>& neighbours() const { return neighbours_; }
  bool on_rim(int vertex) const { return on_rim_[std::size_t(vertex)] != 0; }
  double mean_edge() const { return mean_edge_; }

 private:
  Eigen::Matrix3Xd vertices_, normals_;
  Triangles triangles_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<char> on_rim_;
  double mean_edge_ = 0;
};

}  // namespace gridshell
