// Relaxation of a rough state over meshes of increasing fineness: 1, 2, 4 ... edges per segment. A
// coarse mesh has few states, and each descent from one mesh to the next is short.
#pragma once

#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/elastic/state.h"
#include "engine/footprint/actuation.h"
#include "engine/footprint/mesh.h"
#include "engine/footprint/symmetry.h"
#include "engine/solve/equilibrium.h"
#include "engine/solve/mesh_levels.h"

namespace gridshell {

/// The meshes of one footprint, each with a factorisation of its own. A result is an equilibrium of
/// the finest mesh, as coarse meshes have states that finer ones do not have.
class MultilevelRelaxation {
 public:
  /// Meshes of 1, 2, 4 ... edges per segment, the last `edges` (a power of two). Errors
  /// (bad_input): rods that the rod model does not support.
  static Result<MultilevelRelaxation> make(const Footprint& footprint, const ShellRods& rods,
                                           RodModel rod_model, const BoundaryMotion& motion,
                                           const FlatFrame& flat, int edges);

  /// Nodes of the coarsest mesh (3 x n, mm): the flat footprint under the affine map that brings
  /// the ends closest to their positions at t.
  Eigen::Matrix3Xd stretched_flat(double t) const;
  /// Relaxes positions of the coarsest mesh's nodes, with prescribed positions at t, to a stable
  /// equilibrium on the finest mesh. Errors: no_equilibrium, cancelled.
  Result<State> rest(double t, const Eigen::Matrix3Xd& nodes, const Watch& watch);
  /// Relaxes with every symmetry of `group` imposed (indices of square_symmetries(), a group of
  /// symmetries of the footprint), then without: the result is the symmetric equilibrium if it is
  /// stable, else the one below it.
  Result<State> rest_confined(double t, const Eigen::Matrix3Xd& nodes,
                              const std::vector<int>& group, const Watch& watch);

  /// Relaxes a state of the finest mesh, with prescribed positions at t, under forces on its
  /// joints. Errors: no_equilibrium, cancelled.
  Result<State> rest_under(const std::vector<NodeAction>& forces, double t, State state,
                           const Watch& watch);

  /// Symmetries of the finest mesh.
  const std::vector<MeshSymmetry>& symmetries() const { return levels_.back()->symmetries; }
  const RodMesh& finest() const { return levels_.back()->mesh; }
  const Model& model() const { return levels_.back()->model; }
  Linearisation& system() { return *levels_.back()->system; }

 private:
  struct Level : MeshLevel {
    std::unique_ptr<StateTransfer> from_coarser;
    std::vector<MeshSymmetry> symmetries;
  };
  MultilevelRelaxation(const FlatFrame& flat, double spacing_mm);
  State begin_of(const Level& level, double t, const Eigen::Matrix3Xd& nodes,
                 const State& coarser) const;
  bool step_to_equilibrium(Level& level, State& state, const Watch& watch) const;
  Result<State> let_go(Level& level, State state, const Watch& watch) const;
  void down(Level& level, const std::vector<MeshSymmetry>& group, State& state,
            const Watch& watch) const;

  FlatFrame flat_;
  double spacing_mm_;
  std::vector<std::unique_ptr<Level>> levels_;  // coarse to fine
};

}  // namespace gridshell
