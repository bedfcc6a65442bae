// Which symmetries of its mesh a shell has, how far its state is from its own images under them,
// and whether rods turn freely.
#pragma once

#include <vector>

#include "engine/footprint/symmetry.h"
#include "engine/simulate/simulation.h"

namespace gridshell::simulate {

/// The symmetries of a mesh that its shell has: none that exchange rods of different properties, or
/// that invert or move loads and rods with natural curvature.
std::vector<MeshSymmetry> symmetries_of_shell(const Scene& scene, const RodMesh& mesh,
                                              const std::vector<MeshSymmetry>& of_mesh);

/// For a shell in the scene's own motion without other constraints: the largest distance between a
/// joint and that of the state's image under a symmetry of the shell, mm. Returns the least such
/// distance above `least_mm` over all symmetries, infinity if there is none. The image is another
/// equilibrium, equally stable and of the same energy.
double distance_of_image(const Simulation& simulation, double least_mm);

/// Whether a state further along the path (nodes of the finest mesh) breaks a symmetry of the shell
/// that the simulation's own state, nearer to the flat one, has: the path branches in between.
bool breaks_more(const Simulation& nearer, const Eigen::Matrix3Xd& nodes);

/// Largest distance, mm, of a rod from the line of its supports about which it turns without force;
/// 0: none does, or a load or a prescribed joint may keep it from turning.
double off_free_axis(const Simulation& simulation);

}  // namespace gridshell::simulate
