// An edge of a rod in a state.
#pragma once

#include <Eigen/Core>

namespace gridshell {

/// An edge vector with what every energy needs of it.
struct EdgeGeometry {
  Eigen::Vector3d tangent = Eigen::Vector3d::UnitX();  ///< unit
  double length = 0;                                   ///< current length, mm
};

}  // namespace gridshell
