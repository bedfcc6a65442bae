// Edges and areas of triangles, which are given as three indices of vertices.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "engine/geometry/mesh_lines.h"

namespace gridshell {

/// Area vector of a triangle, half the cross product of two sides, along its normal, mm^2; `x`: 3 x
/// vertices, mm.
inline Eigen::Vector3d area_of(const Eigen::Matrix3Xd& x, const std::array<int, 3>& t) {
  return 0.5 * (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0]));
}

/// The edge from vertex k of the triangle to the next one, k from 0 to 2.
inline MeshEdge edge_of(const std::array<int, 3>& t, int k) {
  const int a = t[std::size_t(k)], b = t[std::size_t((k + 1) % 3)];
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace gridshell
