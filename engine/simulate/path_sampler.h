// The driver of every experiment: a path is followed on the meshes that confirm it, then its
// samples become frames.
#pragma once

#include <functional>
#include <vector>

#include "engine/record/trajectory.h"
#include "engine/simulate/mesh_policy.h"

namespace gridshell::simulate {

/// The samples of a path that was followed, in the order in which they are shown.
using ChooseSamples = std::function<std::vector<PathSample>(const EquilibriumPath&)>;

/// Follows an experiment with converged_path(), and passes its layout and the frames of its samples
/// to the sink. A frame has what happened since the sample before it: events, contacts, and frames
/// of snaps that were followed in time. If the path ended at a limit before a sample, the state at
/// that limit is the last frame; other samples that the path did not reach have no frame. A sample
/// that cannot be certified becomes the path's limit; within a snap that already is the limit, and
/// in a step, it is added to its reason. Frames do not steer the path; in the end the simulation is
/// in the state of the last one. Errors: those of `follow`; cancelled; those of the sink.
Result<EquilibriumPath> run_experiment(const Scene& scene, const Follow& follow,
                                       const ChooseSamples& choose, record::Sink& sink,
                                       Watch& watch);

}  // namespace gridshell::simulate
