// Where states go to when a hand disturbs them.
#pragma once

#include <memory>
#include <vector>

#include "engine/study/state_library.h"

namespace gridshell::simulate {

/// Lets out the boundary of the first `jitter.transitions` states of a library until each ends, and
/// draws it in again; and pokes each eight times. What goes to a state that is not in the library
/// goes to 0; what does not come to rest is left out. Progress of the watch from `begun` to `end`.
/// Errors: bad_input, cancelled.
Result<std::vector<record::Transition>> transitions_between(
    const StateLibrary& library, const std::shared_ptr<const Scene>& scene,
    const preset::SearchSettings& jitter, int threads, double begun, double end, Watch& watch);

// How high the barriers between states are.

/// The lowest passes between the states of a library that its picture shows: a way is followed from
/// each to the nearest images of two others, and from the saddle on it down on either side,
/// whatever states that leads to. Of several passes between two states the lowest. On the mesh that
/// states are judged on. Counts of ways and of passes go into `library.search`, the lowest way out
/// of each state into its row. Progress of the watch from `begun` to `end`. Errors: bad_input,
/// cancelled.
Result<std::vector<record::Barrier>> barriers_between(StateLibrary& library,
                                                      const std::shared_ptr<const Scene>& scene,
                                                      const preset::SearchSettings& jitter,
                                                      int threads, double begun, double end,
                                                      Watch& watch);

}  // namespace gridshell::simulate
