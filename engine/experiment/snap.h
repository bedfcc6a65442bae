// A snap in time: from a branch that lost its stability to the next rest, with what moves on the
// way.
#pragma once

#include <vector>

#include "engine/experiment/actuation.h"

namespace gridshell::experiment {

/// From the last point of the path that `shell` followed, the motion a little further at `beyond`:
/// the coarsest mesh moves with its mass and the scene's damping until it is at rest, what holds it
/// held; then the static solver brings it down. `frames` gets at most 24 pictures of the way,
/// evenly in time: positions, energies, K and the unbalanced force; pivots and error are not known,
/// `event` says "in motion". Errors: no_equilibrium, cancelled, bad_input (no mass).
Result<State> snap_in_time(const ActuationScene& scene, NestedShell& shell, double beyond,
                           const Watch& watch, std::vector<record::Frame>& frames);

}  // namespace gridshell::experiment
