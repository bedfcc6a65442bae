// One rod without joints, pinned at its ends.
#pragma once

#include "engine/elastic/shell_rods.h"

namespace gridshell {

/// A straight rod along u cut into equal edges; nodes 0 and 1 are its edge points.
inline RodMesh single_rod(int edges, double length) {
  RodMesh mesh;
  mesh.edge_points = 2;
  mesh.rods = {{0}};
  mesh.position = {{0.0}};
  mesh.flat = Eigen::Matrix2Xd::Zero(2, edges + 1);
  for (int k = 1; k <= edges; ++k) {
    const int node = k == edges ? 1 : k + 1;  // edge points are nodes 0 and 1
    mesh.rods[0].push_back(node);
    mesh.position[0].push_back(length * k / edges);
    mesh.flat(0, node) = length * k / edges;
  }
  return mesh;
}

}  // namespace gridshell
