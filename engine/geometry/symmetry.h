// Mirror planes of a shape.
#pragma once

#include <Eigen/Core>

namespace gridshell {

/// Largest distance between the mirror image of a joint in the vertical plane through the z-axis
/// with the horizontal unit `normal` and the joint nearest to it: 0 where the plane is one of the
/// shape's. `joints`: 3 x n, mm.
double mirror_defect(const Eigen::Matrix3Xd& joints, const Eigen::Vector2d& normal);

}  // namespace gridshell
