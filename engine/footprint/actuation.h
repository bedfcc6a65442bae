// Prescribed motion of the boundary, and what selects a branch where a path loses its stability.
#pragma once

#include <Eigen/Core>

namespace gridshell {

/// Motion of the edge points, straight and linear in the progress. Column 2r is the start of rod r,
/// column 2r + 1 its end. `begin`: original, `end`: actuated boundary.
struct BoundaryMotion {
  Eigen::Matrix3Xd begin, end;  ///< positions, 3 x edge points, mm
  /// Unit tangents at the edge points, in the direction in which positions along the rod grow;
  /// needed if a direction is prescribed.
  Eigen::Matrix3Xd begin_tangent = {}, end_tangent = {};
  /// Far ends of the tails, which rotate about their edge points; needed if rods have tails.
  Eigen::Matrix3Xd begin_far = {}, end_far = {};
  /// Positions of the joints that the boundary fixes, in the footprint's order.
  Eigen::Matrix3Xd begin_joints = {}, end_joints = {};
};

/// The buckled shape towards which a flat footprint is pushed.
struct BuckleSeed {
  double up = 1;        ///< +1: upwards, -1: downwards
  double diagonal = 1;  ///< +1: the corners on y = x end up lower, -1: those on y = -x
};

/// Imperfection that selects the branch where a path loses its stability: the path continues to the
/// side of the imperfection's part along the modes that lost stability. Every certified state is
/// one of the perfect shell.
struct Imperfection {
  double size_mm = 2e-3;  ///< amplitude with which a branch is entered; 0: the path remains on the
                          ///< symmetric branch, through unstable states
  int seed = 1;
  /// false: a random direction per joint; true: the lowest mode itself, with opposite signs for odd
  /// and even seeds
  bool soft_mode = false;

  /// Whether a branch is selected.
  bool chooses() const { return size_mm > 0; }
};

}  // namespace gridshell
