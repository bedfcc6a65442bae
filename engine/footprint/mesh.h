// The footprint's rods cut into edges: nodes, their flat positions and rest lengths.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/footprint/footprint.h"

namespace gridshell {

/// Nodes of all rods. Joints come first (node = index of the joint, shared by its two rods), then
/// edge points (rod r has node joints + 2r at its begin, joints + 2r + 1 at its end), then the
/// nodes inside segments and legs, rod by rod.
struct RodMesh {
  int edges_per_segment = 0;
  int joints = 0;
  int edge_points = 0;
  std::vector<std::vector<int>> rods;         ///< nodes of each rod from edge point to edge point
  std::vector<std::vector<double>> position;  ///< of those nodes along their rod in the flat, mm
  Eigen::Matrix2Xd flat;                      ///< (u, v) of every node, mm

  int nodes() const { return int(flat.cols()); }
};

/// Cuts each segment into `edges_per_segment` = k edges, and each leg too; a leg shorter than d/4 is
/// cut into 2^p edges only, where k = b 2^p and b is odd or at most 4. So the meshes of 4, 8, 16 ...
/// (and 3, 6, 12 ...) edges nest: halving every edge of one gives the next.
RodMesh mesh_rods(const Footprint& footprint, int edges_per_segment);

/// Positions on a finer or coarser mesh of the same footprint by cubic interpolation along each rod
/// (through the nodes, with the tangents of a quadratic fit); joints and edge points are kept.
Eigen::Matrix3Xd interpolate(const RodMesh& from, const Eigen::Matrix3Xd& x, const RodMesh& to);

}  // namespace gridshell
