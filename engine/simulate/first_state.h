// Where a path begins: a buckled state out of the flat, the rest beside a net, or that of what is
// drawn, in space or under loads alone.
#pragma once

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/scene/scene.h"
#include "engine/solve/nested_shell.h"

namespace gridshell {

/// By how much the joints far out on y = -x lie higher than those on y = x, mm; nodes: joints
/// first.
double lower_on_diagonal(const RodMesh& mesh, const Eigen::Matrix3Xd& nodes);

/// The seed's buckled state of the coarsest mesh at t, at rest. Every rung and mesh starts from the
/// shape of the bend rung on 4 edges a segment: neither what twist and springs add nor the mesh
/// asked for chooses the branch. Of the two diagonals the
/// one asked for lies lower; a dome that went to the other is begun from the other seed, which for
/// symmetric footprints is its mirror image. Errors: no_equilibrium, cancelled, bad_input (rods
/// that the rung cannot take).
Result<State> buckled_state(NestedShell& shell, const Scene& scene, const ShellRods& rods, double t,
                            const Watch& watch);

/// Whether a path begins at the rest of what is drawn: of a network in space, and in the flat where
/// loads bend the rods, now or by cases to come, and no boundary shortens them.
bool begins_as_drawn(const Scene& scene, const RodMesh& mesh, const PinnedMotion& motion);

/// The rest that what is drawn comes to, its supports where they are drawn; found on the same mesh.
/// Errors: as buckled_state().
Result<State> state_as_drawn(NestedShell& shell, const Scene& scene, const ShellRods& rods,
                             const Watch& watch);

/// The state of the coarsest mesh next to the scene's net, at rest. Errors: as buckled_state(), and
/// the net's.
Result<State> state_on_net(NestedShell& shell, const Scene& scene, const Watch& watch);

}  // namespace gridshell
