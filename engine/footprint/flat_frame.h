// Where the flat footprint lies in space.
#pragma once

#include <Eigen/Core>

namespace gridshell {

/// The flat (u, v) plane in the frame of the scene: a point (u, v) lies at origin + axes (u, v).
/// The axes are orthonormal and horizontal, u x v = z.
struct FlatFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 2> axes = Eigen::Matrix<double, 3, 2>::Identity();

  Eigen::Vector3d at(const Eigen::Vector2d& uv) const;
  Eigen::Matrix3Xd all(const Eigen::Matrix2Xd& uv) const;
};

}  // namespace gridshell
