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

/// Finds the rods that may rotate about a line without force: rods with at most two hinges, and
/// rods all of whose hinges the boundary keeps on one line. A rod with prescribed end directions is
/// one of them only if it is round and straight and the directions are along that line.
std::vector<TurningRod> turning_rods(const Footprint& footprint, const ShellRods& rods,
                                     const BoundaryMotion& motion, RodModel rod_model);

/// The nodes of a rod that turns; `from` and `to` are two nodes on its axis.
struct TurningNodes {
  int from = 0, to = 0;
  std::vector<int> nodes;
  int section = -1;  ///< index of the rod if its section turns with it (no prescribed direction)
};

/// The nodes, on `mesh`, of those turning rods that have two different nodes on their axis.
std::vector<TurningNodes> turning_nodes(const std::vector<TurningRod>& turning,
                                        const Footprint& footprint, const RodMesh& mesh);

/// Rotates each rod about its axis so that its nodes are nearest to those of `to`, relative to
/// `from`. Returns the largest move, mm.
double turn_towards(const Eigen::Matrix3Xd& to, const std::vector<TurningNodes>& rods,
                    const Model& model, State& state);

}  // namespace gridshell
