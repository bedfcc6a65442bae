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

/// The edge point of an end, or where it is joined that joint.
int end_node(const RodMesh& mesh, int k);

/// Nodes that may be constrained: joints, edge points, far ends of tails.
std::vector<int> supports_of(const RodMesh& mesh);

/// Reactions at the supports, N: the complete force on a pinned node, including the couple that
/// clamps its end; at a joint the constrained components; at a spring support the spring's force.
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

/// Cross-section area of the solid section with this fibre reach, mm^2.
double area_of(const FibreReach& fibres);

/// Whether all that bends is strained as it is curved (FibreReach).
bool strains_by_curvature(const Model& model);

/// The largest strain by bending and stress, and where they are. `strain`: of all points, rod after
/// rod; the frame's axial forces are known.
void put_strains(const Scene& scene, const RodMesh& mesh, const Model& model,
                 const std::vector<double>& strain, record::Frame& frame);

/// Writes forces, curvature, bending and stress along the rods of an equilibrium on one mesh, with
/// the forces at it. Ends without a prescribed direction have no moment.
void put_rods(const Scene& scene, const RodMesh& mesh, const Model& model, const State& state,
              const Assembly& at, record::Frame& frame);

}  // namespace gridshell::simulate
