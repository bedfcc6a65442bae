// What a sweep computes at a point.
#pragma once

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/sweep.h"

namespace gridshell::experiment {

/// The figures of a preset's run: those of summary.json but for its seconds, for its last state;
/// how far that is (progress, below 1 where the path ended early), the depth and the force of a
/// push (depth_mm, force_N), and what its rods are: stiffness_ratio, EA d^2/EI; of a circle the
/// paper's longest and shortest leg (legs.h). Of a preset that looks for states: the figures of the
/// state of lowest energy, then those of the search (search_figures.h). `[movie]` and `[figure]`
/// change none of them. Errors: bad_input, no_equilibrium, cancelled.
Result<record::Figures> figures_of(const preset::Preset& preset, Watch& watch);

/// The names of all figures that figures_of() can give for runs, or for searches for states.
std::vector<std::string> figure_names(bool search);

}  // namespace gridshell::experiment
