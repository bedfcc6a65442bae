// The faces that rods and boundary enclose: what snow lies on and wind presses on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/footprint/footprint.h"

namespace gridshell {

/// A face of the net: its corners in order, anticlockwise as seen from above the flat. Nodes are
/// those of every mesh: joints, then edge points, begin and end of rod r at 2 r and 2 r + 1.
struct Face {
  std::vector<int> corners;
  bool on_boundary = false;  ///< from its last corner to its first there is no rod but the boundary
};

/// All faces of a footprint in the plane, walked round with the face on the left: at every node
/// along the next rod to the left of the one it came by. Where the walk comes to an edge point a
/// face ends, and the boundary closes it by a straight line.
std::vector<Face> faces_of(const Footprint& footprint);

/// 1/2 sum of x_k x x_(k+1), mm^2: the area of a face of a shape, along its normal; its z is the
/// area in plan.
Eigen::Vector3d area_of(const Face& face, const Eigen::Matrix3Xd& nodes);

}  // namespace gridshell
