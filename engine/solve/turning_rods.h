// Rods that rotate about a line without force: they buckle to any side, and their states differ by
// an angle that nothing determines.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/elastic/shell_rods.h"
#include "engine/elastic/state.h"
#include "engine/footprint/actuation.h"
#include "engine/footprint/footprint.h"
#include "engine/footprint/mesh.h"

namespace gridshell {

/// A rod that turns, and the joints at which others or the boundary fix it.
struct TurningRod {
  std::size_t rod = 0;
  std::vector<int> hinges;
};

/// Rods that may rotate about a line without force: those with at most two hinges, and those of
/// which the boundary keeps all hinges on one line; with prescribed directions on that line only
/// round straight ones.
std::vector<TurningRod> turning_rods(const Footprint& footprint, const ShellRods& rods,
                                     const BoundaryMotion& motion, RodModel rod_model);

/// The nodes of a rod that turns, and two of them that its line goes through.
struct TurningNodes {
  int from = 0, to = 0;
  std::vector<int> nodes;
  int section = -1;  ///< the rod if its section turns with it, where no direction is prescribed
};

/// Those of the rods with two points of their line on a mesh.
std::vector<TurningNodes> turning_nodes(const std::vector<TurningRod>& turning,
                                        const Footprint& footprint, const RodMesh& mesh);

/// Rotates each rod about its line so that its nodes are nearest to `to`; returns the largest move,
/// mm.
double turn_towards(const Eigen::Matrix3Xd& to, const std::vector<TurningNodes>& rods,
                    const Model& model, State& state);

}  // namespace gridshell
