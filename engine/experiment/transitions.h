// Where states go to when a hand disturbs them.
#pragma once

#include <memory>
#include <vector>

#include "engine/experiment/states.h"

namespace gridshell::experiment {

/// Lets out the boundary of the first `jitter.transitions` states of a library until each ends, and
/// draws it in again; and pokes each eight times. What goes to a state that is not in the library
/// goes to 0; what does not come to rest is left out. Progress of the watch from `begun` to `end`.
/// Errors: bad_input, cancelled.
Result<std::vector<record::Transition>> ways_between(const StateLibrary& library,
                                                     const std::shared_ptr<const Scene>& scene,
                                                     const preset::Jitter& jitter, int threads,
                                                     double begun, double end, Watch& watch);

}  // namespace gridshell::experiment
