// The total of K from the shell's corner joints, by code that shares nothing with the cells' own.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "engine/record/shape_measures.h"

namespace gridshell {

/// Total K from the joints alone: with one tangent a rod at a joint its angles sum to 2 pi around,
/// so inner joints cancel, and what is left is, with alpha the angle of the cells that are there:
/// pi/2 - alpha at a joint of one cell, beta - pi/2 at one of three (beta that of the missing
/// cell), 2 (pi/2 - alpha) at one of two opposite cells, 0 else. Computed from the four outgoing
/// directions of the rods, not from cell_curvature.
inline double total_curvature_from_corners(const Footprint& footprint,
                                           const JointTangents& tangents) {
  // which of the four quadrants around a joint hold a cell, counter-clockwise from (+u, +v)
  std::vector<std::array<bool, 4>> holds(footprint.joints.size(), {false, false, false, false});
  for (const FootprintCell& cell : footprint.cells)
    for (int corner = 0; corner < 4; ++corner) holds[cell.joints[corner]][corner] = true;

  double total = 0;
  for (std::size_t j = 0; j < holds.size(); ++j) {
    // omega: the angle of quadrants (+,+) and (-,-); the other two have pi - omega
    const Eigen::Vector3d u = tangents.u.col(Eigen::Index(j)), v = tangents.v.col(Eigen::Index(j));
    const double omega = 2 * std::atan2((u - v).norm(), (u + v).norm());
    const int even = holds[j][0] + holds[j][2], odd = holds[j][1] + holds[j][3];
    const int cells = even + odd;
    if (cells == 1) total += even ? M_PI / 2 - omega : omega - M_PI / 2;
    if (cells == 3) total += (even == 1 ? omega : M_PI - omega) - M_PI / 2;
    if (cells == 2 && even != 1) total += even == 2 ? M_PI - 2 * omega : 2 * omega - M_PI;
  }
  return total;
}

}  // namespace gridshell
