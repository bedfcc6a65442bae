// Leaving a branch that ended: which way a shell goes, and where it comes to rest.
#pragma once

#include <functional>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/simulate/simulation.h"
#include "engine/solve/dynamics.h"
#include "engine/solve/equilibrium.h"
#include "engine/solve/nested_shell.h"

namespace gridshell {

/// How the scene's imperfection leaves a state that lost its stability. Drawn a joint, so it is the
/// same on every mesh.
BranchSwitch departure_of(const Scene& scene, const RodMesh& mesh, const Model& model);

/// Where the shell, on its coarsest mesh, comes to rest that lost its branch at `last`, with what
/// is prescribed at `there`: down the energy, or in time where the scene wants it, every time step
/// then in `moments`. At a loss of stability the imperfection says to which side, at a limit point
/// the energy. Errors: bad_input (a mass not known), no_equilibrium, cancelled.
Result<State> rest_after_bifurcation(NestedShell& shell, const Scene& scene, const PathPoint& last,
                                     Event::Kind kind, double there,
                                     std::vector<TimedState>& moments, const Watch& watch);

/// Whether a rest at `there` lies on a branch that leaves the path at its last state, where it lost
/// its stability: followed back, its distance from the path falls as the root of what is left of
/// the way. Else the shell leapt. On the coarsest mesh.
bool on_branch_from(NestedShell& shell, const Scene& scene, const PathPoint& last, double there,
                    const State& rest, const Watch& watch);

/// Moves in time from a state of the coarsest mesh, with the scene's damping, until it rests.
/// Errors: as rest_after_bifurcation().
Result<State> rest_in_time(NestedShell& shell, const Scene& scene, const State& from,
                           const RestOptions& rest,
                           const std::function<void(const MovingState&)>& seen, const Watch& watch);

}  // namespace gridshell
