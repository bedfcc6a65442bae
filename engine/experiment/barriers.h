// How high the barriers between states are.
#pragma once

#include <memory>
#include <vector>

#include "engine/experiment/states.h"

namespace gridshell::experiment {

/// The lowest passes between the states of a library that its picture shows: a way is followed from
/// each to the nearest images of two others, and from the saddle on it down on either side,
/// whatever states that leads to. Of several passes between two states the lowest. On the mesh that
/// states are judged on. Counts of ways and of passes go into `library.search`, the lowest way out
/// of each state into its row. Progress of the watch from `begun` to `end`. Errors: bad_input,
/// cancelled.
Result<std::vector<record::Barrier>> barriers_between(StateLibrary& library,
                                                      const std::shared_ptr<const Scene>& scene,
                                                      const preset::Jitter& jitter, int threads,
                                                      double begun, double end, Watch& watch);

}  // namespace gridshell::experiment
