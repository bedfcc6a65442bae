// Reactions, loads, brace forces and rod forces of a shell for its frames.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/footprint/footprint.h"
#include "engine/footprint/mesh.h"
#include "engine/record/frame.h"
#include "engine/scene/scene.h"
#include "engine/solve/newton.h"

namespace gridshell::simulate {

/// The node of rod end `k` (2 r at the start of rod r, 2 r + 1 at its end): its edge point, or the
/// joint to which it is joined.
int end_node(const RodMesh& mesh, int k);

/// Nodes that may be constrained: joints, edge points, far ends of tails.
std::vector<int> supports_of(const RodMesh& mesh);

/// Reactions at the supports, N: the complete force on a pinned node, including the couple that
/// clamps its end; at a joint the constrained components; at a spring support the spring's force.
Eigen::Matrix3Xd reactions_of(const RodMesh& mesh, const Model& model, const Assembly& at,
                              const std::vector<Constraint>& constraints);

/// External forces in a state at `x`, N, on the nodes that supports_of() lists: forces between two
/// of them are distributed to both as by a beam, so that the sum is that of all forces. Empty:
/// there are none. Rods that close without a joint are left out.
Eigen::Matrix3Xd loads_on(const RodMesh& mesh, const Model& model, const Eigen::Matrix3Xd& x,
                          const ExternalLoads& outside);

/// Axial forces of the braces along both diagonals of every cell, N; NaN: there is no brace. Empty:
/// the shell has none.
Eigen::VectorXd brace_forces(const Footprint& footprint, const Model& model,
                             const Eigen::Matrix3Xd& x);

/// Cross-section area of the solid section with this fibre reach, mm^2.
double area_of(const FibreReach& fibres);

/// Whether the bending strain of all rods follows from their curvature alone (FibreReach), without
/// axes of a section and clamped ends.
bool strains_by_curvature(const Model& model);

/// Writes the largest bending strain and stress, and where on the rods they are. `strain`: bending
/// strain at all points, rod after rod. The frame must have its axial forces.
void put_strains(const Scene& scene, const RodMesh& mesh, const Model& model,
                 const std::vector<double>& strain, record::Frame& frame);

/// Writes forces, curvature, bending and stress along the rods of an equilibrium on one mesh. `at`:
/// the forces in this state. Ends without a prescribed direction have no moment.
void put_rods(const Scene& scene, const RodMesh& mesh, const Model& model, const State& state,
              const Assembly& at, record::Frame& frame);

}  // namespace gridshell::simulate
