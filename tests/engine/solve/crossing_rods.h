// A shallow arch of two crossing rods: the smallest gridshell that snaps.
#pragma once

#include <cmath>
#include <vector>

#include "engine/elastic/shell_rods.h"
#include "engine/solve/newton.h"

namespace gridshell {

/// Two rods of 100 mm that cross in the middle; node 0 is their joint, 1 to 4 are edge points.
inline RodMesh crossing_rods(int edges_per_half) {
  RodMesh mesh;
  mesh.joints = 1;
  mesh.edge_points = 4;
  const int n = 2 * edges_per_half;
  mesh.flat = Eigen::Matrix2Xd::Zero(2, 5 + 2 * (n - 2));
  int next = 5;
  for (int r = 0; r < 2; ++r) {
    std::vector<int> nodes;
    std::vector<double> at;
    for (int k = 0; k <= n; ++k) {
      const int node = k == 0 ? 1 + 2 * r : k == n ? 2 + 2 * r : k == n / 2 ? 0 : next++;
      nodes.push_back(node);
      at.push_back(100.0 * k / n - 50);
      mesh.flat(r, node) = at.back();
    }
    mesh.rods.push_back(nodes);
    mesh.position.push_back(at);
  }
  return mesh;
}

/// About the arch that these rods rise to when their ends come 2 % together.
inline State crossing_arch(const Model& model) {
  State state;
  state.x = Eigen::Matrix3Xd::Zero(3, model.nodes);
  state.force.setZero(Eigen::Index(model.edges.size()));
  for (int node = 0; node < model.nodes; ++node) {
    const Eigen::Vector2d p = model.flat.col(node);
    state.x.col(node) << 0.98 * p, 7 * std::cos(M_PI * p.norm() / 100);
    if (model.pinned(node)) state.x(2, node) = 0;
  }
  return state;
}

}  // namespace gridshell
