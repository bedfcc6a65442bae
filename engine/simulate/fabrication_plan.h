// From a preset to what is built by hand.
#pragma once

#include "engine/core/result.h"
#include "engine/preset/preset.h"
#include "engine/record/fabrication.h"

namespace gridshell::simulate {

/// The rods, marks, boundaries and pins of a preset's footprint. Errors: bad_input, as scene_of().
Result<exports::FabricationPlan> fabrication_plan_of(const preset::Preset& preset);

}  // namespace gridshell::simulate
