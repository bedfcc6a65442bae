// A shallow arch of two crossing rods: the smallest gridshell that snaps.
#pragma once

#include <cmath>

#include "engine/elastic/model.h"
#include "engine/elastic/shell_rods.h"
#include "engine/solve/newton.h"
#include "tests/presets.h"

namespace gridshell {

/// Two rods of 100 mm that cross in the middle; node 0 is their joint, 1 to 4 are edge points.
inline RodMesh crossing_rods(int edges_per_half) {
  return mesh_rods(value_of(scene_of(network(cross(50, 50)))).footprint, edges_per_half);
}

/// An approximation of the arch to which these rods rise if their ends approach by 2 %.
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
