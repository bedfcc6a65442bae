// Two nodes held together by a spring: crossing rods, each with a node of its own at the joint, or
// a support and the rod's end or joint that hangs on it.
#pragma once

#include <Eigen/Core>

#include "engine/rod/energies.h"

namespace gridshell {

/// E = 1/2 sum over x, y, z of k (x_b - x_a)^2 of nodes a and b: without length at rest.
struct NodeSpring {
  int a = 0, b = 0;
  Eigen::Vector3d stiffness{0, 0, 0};  ///< k along x, y, z, N/mm
  Term term = Term::joint;

  double value(const Eigen::Vector3d& gap) const { return 0.5 * stiffness.dot(gap.cwiseAbs2()); }
  Eigen::Vector3d gradient(const Eigen::Vector3d& gap) const { return stiffness.cwiseProduct(gap); }
};

}  // namespace gridshell
