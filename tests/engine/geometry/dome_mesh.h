// Meshes of ellipsoids and of height fields for tests.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

namespace gridshell {

struct DomeMesh {
  Eigen::Matrix3Xd vertices;
  std::vector<std::array<int, 3>> triangles;
};

inline Eigen::Vector3d on_ellipsoid(const Eigen::Vector3d& axes, double polar, double around) {
  return {axes.x() * std::sin(polar) * std::cos(around),
          axes.y() * std::sin(polar) * std::sin(around), axes.z() * std::cos(polar)};
}

/// Rings of vertices on an ellipsoid about the origin, from its top down to a polar angle, edges of
/// about `edge_mm` on its meridians.
inline DomeMesh ellipsoid_mesh(const Eigen::Vector3d& axes, double edge_mm,
                               double down = M_PI / 2) {
  const int rings = int(std::ceil(axes.z() * down / edge_mm));
  DomeMesh mesh{Eigen::Matrix3Xd(3, 1 + 3 * rings * (rings + 1)), {}};
  const auto begin = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  mesh.vertices.col(0) = on_ellipsoid(axes, 0, 0);
  for (int ring = 1; ring <= rings; ++ring) {
    const int count = 6 * ring, inner = 6 * (ring - 1);
    for (int k = 0; k < count; ++k)
      mesh.vertices.col(begin(ring) + k) =
          on_ellipsoid(axes, down * ring / rings, 2 * M_PI * k / count);
    // along both rings, advancing the one that is behind
    for (int i = 0, k = 0; i < inner || k < count;) {
      const int here = begin(ring - 1) + (inner > 0 ? i % inner : 0),
                there = begin(ring) + k % count;
      const bool outer =
          inner == 0 || i == inner || (k < count && (k + 1) * inner <= (i + 1) * count);
      if (outer)
        mesh.triangles.push_back({here, there, begin(ring) + ++k % count});
      else
        mesh.triangles.push_back({here, there, begin(ring - 1) + ++i % inner});
    }
  }
  return mesh;
}

/// n x n squares, each halved by the diagonal from its first vertex; vertex (i, j), at `at(i, j)`,
/// is column (n + 1) j + i.
template <class At>
DomeMesh grid_mesh(int n, const At& at) {
  DomeMesh mesh{Eigen::Matrix3Xd(3, (n + 1) * (n + 1)), {}};
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const int a = (n + 1) * j + i;
      mesh.vertices.col(a) = at(i, j);
      if (i == n || j == n) continue;
      mesh.triangles.push_back({a, a + 1, a + n + 2});
      mesh.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  return mesh;
}

}  // namespace gridshell
