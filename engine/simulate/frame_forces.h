// What holds a shell, what loads it and what braces it, as its frames tell it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/footprint/footprint.h"
#include "engine/footprint/mesh.h"
#include "engine/solve/newton.h"

namespace gridshell::simulate {

/// The edge point of an end, or where it is joined that joint.
int end_node(const RodMesh& mesh, int k);

/// What may be held: joints, edge points, far ends of tails.
std::vector<int> supports_of(const RodMesh& mesh);

/// What holds the supports, N: all of the force on a pinned node, with what turns its end; of a
/// joint what its hold prescribes; the force of its spring where it is on one.
Eigen::Matrix3Xd reactions_of(const RodMesh& mesh, const Model& model, const Assembly& at,
                              const std::vector<Constraint>& holds);

/// What acts from outside in a state at `x`, N, on the supports: forces between two of them are
/// handed on to both as a beam does, so that the sum is that of all. Empty: nothing acts. Rods that
/// close without a joint are left out.
Eigen::Matrix3Xd loads_on(const RodMesh& mesh, const Model& model, const Eigen::Matrix3Xd& x,
                          const ExternalLoads& outside);

/// Axial forces of the braces along both diagonals of every cell, N; NaN: there is none. Empty:
/// nothing is braced.
Eigen::VectorXd brace_forces(const Footprint& footprint, const Model& model,
                             const Eigen::Matrix3Xd& x);

}  // namespace gridshell::simulate
