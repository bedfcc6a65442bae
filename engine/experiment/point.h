// What a sweep computes at a point.
#pragma once

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/sweep.h"

namespace gridshell::experiment {

/// The figures of a preset's run: those of summary.json but for its seconds, for its last state;
/// how far that is (progress, below 1 where the path ended early), the depth and the force of a
/// push (depth_mm, force_N), and what its rods are: stiffness_ratio, EA d^2/EI. `[movie]` and
/// `[figure]` change none of them. Errors: bad_input, no_equilibrium, cancelled.
Result<record::Figures> figures_of(const preset::Preset& preset, Watch& watch);

/// The names of all figures that figures_of() can give.
std::vector<std::string> figure_names();

}  // namespace gridshell::experiment
