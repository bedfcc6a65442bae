// Branch switching: in which direction a shell leaves a branch that ended, and which equilibrium it
// reaches.
#pragma once

#include <functional>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/simulate/simulation.h"
#include "engine/solve/dynamics.h"
#include "engine/solve/equilibrium.h"
#include "engine/solve/nested_shell.h"

namespace gridshell {

/// The branch switch that the scene's imperfection chooses for a state that lost its stability. Its
/// random direction is drawn joint by joint, so it is the same on every mesh.
BranchSwitch departure_of(const Scene& scene, const RodMesh& mesh, const Model& model);

/// The equilibrium that the shell reaches on its finest mesh after it lost its branch at `last`,
/// with the prescribed components at `there`: by minimising the energy, or in time if the scene
/// requests it, with every time step in `moments`. At a loss of stability the imperfection chooses
/// the side, at a limit point the energy. Errors: bad_input (a mass is not known), no_equilibrium,
/// cancelled.
Result<State> rest_after_bifurcation(NestedShell& shell, const Scene& scene, const PathPoint& last,
                                     Event::Kind kind, double there,
                                     std::vector<TimedState>& moments, const Watch& watch);

/// Whether the equilibrium at `there` is on a branch that bifurcates from the path at its last
/// state: followed back, its distance from the path falls as the square root of the remaining path
/// parameter. If not, the shell snapped. On the finest mesh.
bool on_branch_from(NestedShell& shell, const Scene& scene, const PathPoint& last, double there,
                    const State& rest, const Watch& watch);

/// Moves in time from a state of the finest mesh, with the scene's damping, until equilibrium.
/// Errors: as rest_after_bifurcation().
Result<State> rest_in_time(NestedShell& shell, const Scene& scene, const State& from,
                           const RestOptions& rest,
                           const std::function<void(const MovingState&)>& seen, const Watch& watch);

}  // namespace gridshell
