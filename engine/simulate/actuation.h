// The actuation of a footprint: its edge points move straight and evenly from the original to the
// actuated boundary, through equilibria.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "engine/record/trajectory.h"
#include "engine/simulate/equilibrium_path.h"

namespace gridshell::simulate {

/// Follows the actuation of a scene. From the flat state: a first buckled state is computed where
/// the rods' mean shortening is 2 % (or less, if that state is not connected to the flat one), and
/// the path is followed from it back towards the flat and forward to progress `to`. If the segment
/// back contains unstable states, a shell would not follow it; the path then starts next to the
/// flat, unless the scene's imperfection is zero. From the net: the path starts at the equilibrium
/// next to the net, progress 1, and is followed backwards from there if `inner` states are
/// requested. Errors: bad_input, no_equilibrium (no buckled state), cancelled.
Result<EquilibriumPath> follow_actuation(const std::shared_ptr<const Scene>& scene,
                                         const LevelPlan& plan, bool inner, double to,
                                         const Watch& watch, const RunContext& context = {});

/// Follows the actuation to progress 1 for a later task: its segments are `earlier`, without their
/// states. An actuation that ends earlier is an error, no_equilibrium, "there is no actuated shell
/// `purpose`: ..."; one whose mesh is too_coarse() is returned as far as it was followed,
/// and one that is formed, with a segment back that ended early, is returned.
Result<EquilibriumPath> follow_whole_actuation(const std::shared_ptr<const Scene>& scene,
                                               const LevelPlan& plan, std::string_view purpose,
                                               const Watch& watch, const RunContext& context = {});

/// The actuation on the coarsest meshes that confirm it (mesh_policy.h): its limit reports what
/// they do not. Errors: as follow_actuation().
Result<EquilibriumPath> converged_actuation(const std::shared_ptr<const Scene>& scene, bool inner,
                                            double to, const Watch& watch,
                                            const RunContext& context = {});

/// Passes frames at `progress` (ascending, in [0, 1]; 0 is the flat footprint) to the sink. If the
/// path ends before a sample, the path's limit gives the reason. Errors: as follow_actuation(), and
/// those of the sink.
Result<EquilibriumPath> run_actuation(std::shared_ptr<const Scene> scene,
                                      const std::vector<double>& progress, record::Sink& sink,
                                      Watch& watch, const RunContext& context = {});

}  // namespace gridshell::simulate
