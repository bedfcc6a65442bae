// How the ends of a footprint's rods are meant to move.
#pragma once

#include <Eigen/Core>

namespace gridshell {

/// Where the edge points are as the boundary moves, straight and evenly: column 2r is the begin, 2r
/// + 1 the end of rod r. The far end of a tail turns about its edge point.
struct BoundaryMotion {
  Eigen::Matrix3Xd begin, end;  ///< 3 x edge points, mm
  /// unit tangents there, along the rod as its positions grow; needed where a direction is held
  Eigen::Matrix3Xd begin_tangent = {}, end_tangent = {};
  /// far ends of the tails there; needed where rods have tails
  Eigen::Matrix3Xd begin_far = {}, end_far = {};
  /// joints that the boundary holds, in the footprint's order
  Eigen::Matrix3Xd begin_joints = {}, end_joints = {};
};

}  // namespace gridshell
