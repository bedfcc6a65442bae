// The first state of a path: a buckled state of a flat grid, the equilibrium next to a net, or the
// equilibrium of a drawn network, in space or under loads alone.
#pragma once

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/scene/scene.h"
#include "engine/solve/nested_shell.h"

namespace gridshell {

/// By how much the joints near the diagonal y = -x are higher than those near y = x, mm; joints far
/// from the centre count most. `nodes`: joints first.
double lower_on_diagonal(const RodMesh& mesh, const Eigen::Matrix3Xd& nodes);

/// The seed's buckled state in equilibrium on the coarsest mesh at t. Every rod model and mesh
/// starts from the shape of the bend model on 4 edges per segment, so that neither twist and
/// springs nor the requested mesh choose the branch. Of the two diagonals the requested one is
/// lower; a dome that buckled along the other is started again from the other seed, which for
/// symmetric footprints is its mirror image. Errors: no_equilibrium, cancelled, bad_input (rods
/// that the rod model does not support).
Result<State> buckled_state(NestedShell& shell, const Scene& scene, const ShellRods& rods, double t,
                            const Watch& watch);

/// Whether a path starts at the equilibrium of the drawn shape: for a network in space, and for a
/// flat one if loads bend the rods, now or by later cases, and no boundary shortens them.
bool begins_as_drawn(const Scene& scene, const RodMesh& mesh, const PinnedMotion& motion);

/// The equilibrium that the drawn shape relaxes to, with its supports at their drawn positions;
/// found on the same mesh. Errors: as buckled_state().
Result<State> state_as_drawn(NestedShell& shell, const Scene& scene, const ShellRods& rods,
                             const Watch& watch);

/// The equilibrium of the coarsest mesh next to the scene's net. Errors: as buckled_state(), and
/// those of the net.
Result<State> state_on_net(NestedShell& shell, const Scene& scene, const Watch& watch);

}  // namespace gridshell
