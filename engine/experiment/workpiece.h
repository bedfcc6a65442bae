// From a preset to what is built by hand.
#pragma once

#include "engine/core/result.h"
#include "engine/export/workpiece.h"
#include "engine/preset/preset.h"

namespace gridshell::experiment {

/// The rods, marks, boundaries and pins of a preset's footprint. Errors: bad_input, as scene_of().
Result<exports::Workpiece> workpiece_of(const preset::Preset& preset);

}  // namespace gridshell::experiment
