// An actuation on the `twist` rung.
#pragma once

#include "engine/experiment/actuation.h"

namespace gridshell::experiment {

/// Samples the path at `progress` as run_actuation does, every mesh of the plan following it by
/// itself from the shape of the `bend` rung or of the net; the differences between the meshes give
/// the error. Frames are minima of the energy; nearer to the flat than the first buckled state they
/// are equilibria that say how many negative pivots they have. Where the path jumps, `event` and
/// `limit` say so. Errors: as run_actuation.
Result<ActuationOutcome> run_twist_actuation(const ActuationScene& scene,
                                             const std::vector<double>& progress, Watch& watch);

}  // namespace gridshell::experiment
