// A point load by prescribed displacement: one joint of an actuated gridshell is pushed along the
// normal [Baek 2018, 'Nonlocal Response to Point Loading'].
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/experiment/actuation.h"
#include "engine/preset/preset.h"

namespace gridshell::experiment {

/// The joint nearest to the place a preset asks for, as seen from the origin: by its direction on
/// the net, or in the unloaded shell (`joints`, 3 x n) where there is no net. Ties go to the
/// smallest (i, j). Errors (bad_input): a joint by indices that the footprint does not have.
Result<int> pushed_joint(const preset::Indentation& indentation, const Footprint& footprint,
                         const Eigen::Matrix3Xd& joints);

/// Actuates, then pushes. Frames sample the push at `progress` in [0, 1] (of the depth; with
/// `unload` of the way there and back), the first being the unloaded shell; the solver takes load
/// steps of its own in between. Every frame is certified: the residual is that of all forces but
/// the push, the pivots are those of the shell with the joint held where it is.
///
/// The run stops with limit "locking" where a strain passes the scene's max_strain or the push
/// meets 100 times its first stiffness, with a last frame right there; it goes on in another state
/// (event and limit "snap") where the shell held at the joint loses its stability or its
/// equilibrium; it stops with "branch_lost" where no rest is found then. Errors: as run_actuation.
Result<ActuationOutcome> run_indentation(const ActuationScene& scene,
                                         const preset::Indentation& indentation,
                                         const std::vector<double>& progress, Watch& watch);

}  // namespace gridshell::experiment
