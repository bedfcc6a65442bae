// The barriers between the states of a shell.
#pragma once

#include "engine/record/states.h"
#include "render/plot/plot.h"

namespace gridshell::render {

/// The states between which passes are known, in the order of their energy, each a bar at it; from
/// bar to bar a curve over the pass, with its height above the lower one. Passes between images of
/// one state and to states that were not met are left out.
Plot barrier_plot(const record::StateTables& states);

}  // namespace gridshell::render
