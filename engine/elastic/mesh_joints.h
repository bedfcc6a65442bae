// The joints of a meshed footprint: which rods meet there, how they run as drawn, and what
// their laws add to a model.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/core/result.h"
#include "engine/elastic/shell_rods.h"

namespace gridshell {

/// Where a node is drawn, mm; a joint's second one too.
Eigen::Vector3d drawn_place(const RodMesh& mesh, int node);
/// Unit vector between two nodes as drawn.
Eigen::Vector3d drawn_direction(const RodMesh& mesh, int from, int to);

/// A rod and its node at a joint.
struct RodAt {
  int rod = 0, node = 0;
};
using Crossings = std::vector<std::vector<RodAt>>;

/// The rods of every joint in order: of a grid the u rod and the v rod.
Crossings crossings_of(const RodMesh& mesh);

/// How a rod runs through one of its nodes as drawn, unit.
Eigen::Vector3d direction_at(const RodMesh& mesh, const RodAt& of);

/// Unit normals of the joints as drawn: up in the flat, in space across the rods there, all of a
/// piece to one side, the upper one of the whole; zero where no two rods cross.
std::vector<Eigen::Vector3d> normals_of(const RodMesh& mesh, const Crossings& crossings);

/// Adds the laws of every two of the rods of every joint, those of bolts too, and the bolts between
/// axes that lie apart. Errors (bad_input): a law at a joint without centred edges.
Result<void> add_joint_laws(const RodMesh& mesh, const ShellRods& shell, const Crossings& crossings,
                            const std::vector<Eigen::Vector3d>& normals, Model& model);

}  // namespace gridshell
