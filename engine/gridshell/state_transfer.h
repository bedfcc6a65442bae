// States between meshes of one footprint.
#pragma once

#include "engine/footprint/mesh.h"
#include "engine/gridshell/shell_rods.h"
#include "engine/gridshell/state.h"

namespace gridshell {

/// Carries states from a model on one mesh to a model on another: positions by cubic interpolation
/// along the rods, axial forces edge by edge, and of the spins the material frames: their twist is
/// spread along the arc length, and what a clamped end holds is kept to round-off. Meshes and
/// models must outlive it.
class StateTransfer {
 public:
  StateTransfer(const RodMesh& from_mesh, const Model& from, const RodMesh& to_mesh,
                const Model& to);

  State carry(const State& state) const;

  /// Positions alone, of the meshes' nodes.
  const MeshTransfer& meshes() const { return meshes_; }

 private:
  void carry_spins(const State& state, State& carried) const;

  const RodMesh& from_mesh_;
  const RodMesh& to_mesh_;
  const Model& from_;
  const Model& to_;
  MeshTransfer meshes_;
};

}  // namespace gridshell
