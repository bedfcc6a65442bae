// How the ends of a footprint's rods are meant to move.
#pragma once

#include <Eigen/Core>

namespace gridshell {

/// Where the edge points are as the boundary moves, straight and evenly: column 2r is the start, 2r
/// + 1 the end of rod r. The far end of a tail turns about its edge point.
struct BoundaryMotion {
  Eigen::Matrix3Xd begin, end;  ///< 3 x edge points, mm
  /// unit tangents there, along the rod as its positions grow; needed where a direction is
  /// prescribed
  Eigen::Matrix3Xd begin_tangent = {}, end_tangent = {};
  /// far ends of the tails there; needed where rods have tails
  Eigen::Matrix3Xd begin_far = {}, end_far = {};
  /// joints that the boundary fixes, in the footprint's order
  Eigen::Matrix3Xd begin_joints = {}, end_joints = {};
};

// What chooses among the states that a symmetric shell can go to.

/// Which of the many buckled shapes a flat footprint is pushed towards.
struct BuckleSeed {
  double up = 1;        ///< +1 or -1
  double diagonal = 1;  ///< +1: the corners on y = x end up lower, -1: those on y = -x
};

/// What chooses where a path that loses its stability goes: the side on which the imperfection's
/// part along the modes that lost stability points. It only chooses; every certified state is one
/// of the perfect shell.
struct Imperfection {
  double size_mm = 2e-3;  ///< with which a leaving branch is entered; 0: the path stays on the
                          ///< symmetric branch, through states that are not stable
  int seed = 1;
  /// false: a direction per joint, drawn from the seed; true: the lowest mode itself, to one side
  /// of it with odd seeds and to the other with even ones
  bool soft_mode = false;

  bool chooses() const { return size_mm > 0; }
};

}  // namespace gridshell
