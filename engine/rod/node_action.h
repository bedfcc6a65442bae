// What acts on a node from outside: a load, the ground.
#pragma once

#include <Eigen/Core>

#include "engine/rod/energies.h"

namespace gridshell {

/// E = -f . x + 1/2 sum over x, y, z of k (x - a)^2: a dead or transient force, springs to the
/// ground, or both.
struct NodeAction {
  int node = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();      ///< f, N
  Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();  ///< k, N/mm
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();     ///< a, mm
  Term term = Term::load;

  double value(const Eigen::Vector3d& x) const;
  Eigen::Vector3d gradient(const Eigen::Vector3d& x) const;
};

}  // namespace gridshell
