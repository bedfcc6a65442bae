// Crossing rods held together by a spring, each with a node of its own at the joint.
#pragma once

#include <Eigen/Core>

namespace gridshell {

/// E = k/2 |x_b - x_a|^2 of nodes a and b.
struct JointSpring {
  int a = 0, b = 0;
  double stiffness = 0;  ///< k, N/mm

  double value(const Eigen::Vector3d& gap) const { return 0.5 * stiffness * gap.squaredNorm(); }
  Eigen::Vector3d gradient(const Eigen::Vector3d& gap) const { return stiffness * gap; }
};

}  // namespace gridshell
