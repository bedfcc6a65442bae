// One rod without joints, pinned at its ends, with the bend model.
#pragma once

#include "engine/elastic/model.h"
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

/// Nodes of a rod on a line, `stretch` times the natural length, with a bump of height `bump` in z.
inline Eigen::Matrix3Xd straight(const Model& rod, double stretch = 1, double bump = 0) {
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, rod.nodes);
  const Eigen::RowVectorXd u = rod.flat.row(0);
  x.row(0) = stretch * u;
  x.row(2) = (bump * (M_PI / u.maxCoeff() * u).array().sin()).matrix();
  return x;
}

}  // namespace gridshell
