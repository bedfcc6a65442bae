// The actuation of a footprint: its edge points move straight and evenly from the original to the
// actuated boundary, through equilibria.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "engine/record/trajectory.h"
#include "engine/simulate/equilibrium_path.h"

namespace gridshell::simulate {

/// "at progress 0.0183 ± 0.0005", of a path parameter of an actuation.
std::string at_progress(double t, std::optional<double> error);

/// Follows the actuation of a scene. From flat the path is found the patient way: a first buckled
/// state where the rods are 2 % shorter than flat on average (or less, where that state does not
/// hang together with the flat), from there back towards the flat and on to progress `to`. Where
/// that state comes from is not stable all the way, a shell would not have come along it: the path
/// then begins next to the flat, unless the scene's imperfection is none. From the net it is found
/// at the equilibrium next to the net, progress 1, and where `inner` states are wanted followed
/// backwards from there. Errors: bad_input, no_equilibrium (not a single buckled state), cancelled.
Result<EquilibriumPath> follow_actuation(const std::shared_ptr<const Scene>& scene,
                                         const LevelPlan& plan, bool inner, double to,
                                         const Watch& watch);

/// The same to progress 1, for what comes after it: an actuation that ends earlier is an error,
/// no_equilibrium, "there is no actuated shell `wanted_for`: ..."; one whose mesh is too_coarse()
/// is returned as far as it came.
Result<EquilibriumPath> follow_whole_actuation(const std::shared_ptr<const Scene>& scene,
                                               const LevelPlan& plan, std::string_view wanted_for,
                                               const Watch& watch);

/// Hands frames at `progress` (ascending, in [0, 1]; 0 is the flat footprint) to the sink. Where
/// the path ends before a sample, the path's limit says why. Errors: as follow_actuation(), and
/// the sink's.
Result<EquilibriumPath> run_actuation(std::shared_ptr<const Scene> scene,
                                      const std::vector<double>& progress, record::Sink& sink,
                                      Watch& watch);

}  // namespace gridshell::simulate
