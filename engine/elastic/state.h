// The state of a model: positions, angles, axial forces, and reference frames.
#pragma once

#include <Eigen/Core>

#include "engine/elastic/shell_rods.h"
#include "engine/footprint/mesh.h"

namespace gridshell {

struct ModelHinge;

/// A state. Its reference frames belong to its positions, so change `x` only by move_to().
struct State {
  Eigen::Matrix3Xd x;  ///< 3 x columns of the model: positions and angles, mm
  /// unknowns of the mixed form: axial, one per edge, N; then torques of joints with a spring, N mm
  Eigen::VectorXd force;
  Eigen::Matrix3Xd director = {};        ///< twist model: first reference director of each edge
  Eigen::VectorXd reference_twist = {};  ///< twist model: m_ref, one per bend; complete turns count
};

/// A state with the columns at `x`, zero angles and no axial forces. Along each rod the reference
/// frame has no twist and starts with the rod's first director. If `x` has fewer columns than there
/// are nodes, ghosts continue the rods straight past their ends.
State start_state(const Model& model, const Eigen::Matrix3Xd& x);

/// Whether the rods of a hinge have passed one another since they were drawn: the angle between
/// them is below zero.
bool is_closed(const Model& model, const State& state, const ModelHinge& hinge);

/// Moves the columns to x, the reference frames along with them (parallel in time).
void move_to(const Model& model, const Eigen::Matrix3Xd& x, State& state);

/// Moves the nodes of a prescribed end so that the ghost edge of `rod` points along `direction`
/// (from begin to end of the rod).
void set_end_direction(const Model& model, int rod, bool at_end, const Eigen::Vector3d& direction,
                       State& state);

// States between meshes of one footprint.

/// Transfers states from a model on one mesh to a model on another: positions by cubic
/// interpolation along the rods, axial forces edge by edge, torques joint by joint. Angles follow
/// from the material frames, whose twist is distributed along the arc length; at clamped ends the
/// frame is equal up to round-off. Meshes and models must outlive it.
class StateTransfer {
 public:
  StateTransfer(const RodMesh& from_mesh, const Model& from, const RodMesh& to_mesh,
                const Model& to);

  State carry(const State& state) const;

  /// Transfer of the positions of the meshes' nodes alone.
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
