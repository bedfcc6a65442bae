// A footprint's rods on the `twist` rung.
#pragma once

#include "engine/footprint/mesh.h"
#include "engine/gridshell/shell_rods.h"
#include "engine/gridshell/twist_model.h"

namespace gridshell {

/// How crossing rods hold on to each other.
struct JointLaw {
  double spring_N_per_mm = 0;  ///< of spring joints; 0: the rods share a node
  double shear_Nmm = 0;        ///< per rad; 0: they shear freely
  double twist_Nmm = 0;        ///< per rad; 0: they pass no twist
};

/// What the rods of a footprint are on this rung, whatever the mesh.
struct TwistRods {
  std::vector<RodMaterial> materials;  ///< one a rod, or one for all
  JointLaw joints;
  ShellRods loads;  ///< of which the loads count here
};

/// Rods of `mesh`; crossing rods share their joint's node, or, with springs, the v rod's own one
/// comes after the mesh's nodes in the order of the joints. First directors stand up from the flat
/// (+z). Node numbers are the mesh's but for ghosts, which are the last in the mesh's order.
Result<TwistModel> twist_model_of(const RodMesh& mesh, const TwistRods& rods);

/// Positions for that model from positions of the mesh's nodes.
Eigen::Matrix3Xd to_twist_nodes(const RodMesh& mesh, const TwistModel& model,
                                const Eigen::Matrix3Xd& x);
/// And back: a joint is half way between its two rods' nodes.
Eigen::Matrix3Xd from_twist_nodes(const RodMesh& mesh, const TwistModel& model,
                                  const Eigen::Matrix3Xd& x);

}  // namespace gridshell
