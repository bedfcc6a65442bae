// How the ends of a footprint's rods are meant to move, and towards which shape they buckle.
#pragma once

#include <Eigen/Core>

namespace gridshell {

/// Where the edge points are as the boundary moves, straight and evenly: column 2r is the begin, 2r
/// + 1 the end of rod r.
struct BoundaryMotion {
  Eigen::Matrix3Xd begin, end;  ///< 3 x edge points, mm
  /// unit tangents there, along the rod as its positions grow; needed where a direction is held
  Eigen::Matrix3Xd begin_tangent = {}, end_tangent = {};
};

/// Which of the many buckled shapes a flat footprint is pushed towards.
struct BuckleSeed {
  double up = 1;        ///< +1 or -1
  double diagonal = 1;  ///< +1: the corners on y = x end up lower, -1: those on y = -x
};

}  // namespace gridshell
