// The joints of a meshed footprint: which rods meet there, how they run as drawn, and what
// their laws add to a model.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/core/result.h"
#include "engine/elastic/shell_rods.h"

namespace gridshell {

/// Position of a node as drawn, mm; also of the second node of a joint.
Eigen::Vector3d drawn_position(const RodMesh& mesh, int node);
/// Unit vector between two nodes as drawn.
Eigen::Vector3d drawn_direction(const RodMesh& mesh, int from, int to);

/// A rod and its node at a joint.
struct RodAt {
  int rod = 0, node = 0;
};
using Crossings = std::vector<std::vector<RodAt>>;

/// The rods of every joint in order; in a grid the u rod, then the v rod.
Crossings crossings_of(const RodMesh& mesh);

/// Unit direction of a rod at one of its nodes as drawn.
Eigen::Vector3d direction_at(const RodMesh& mesh, const RodAt& of);

/// Unit normals of the joints as drawn. In the flat they point up; in space they are perpendicular
/// to the rods, and those of a connected piece point to one side, on average up. Zero where no two
/// rods cross.
std::vector<Eigen::Vector3d> normals_of(const RodMesh& mesh, const Crossings& crossings);

/// Adds the laws of every joint, for every two of its rods, those of its bolts, and the links of
/// eccentric joints. Errors (bad_input): a law at a joint without centred edges.
Result<void> add_joint_laws(const RodMesh& mesh, const ShellRods& shell, const Crossings& crossings,
                            const std::vector<Eigen::Vector3d>& normals, Model& model);

}  // namespace gridshell
