// From a preset's values to the scene of an actuation: footprint, section, boundary, meshes.
#pragma once

#include "engine/core/result.h"
#include "engine/experiment/actuation.h"
#include "engine/preset/preset.h"

namespace gridshell::experiment {

/// Builds what an actuation needs. Errors: Fault::bad_input with the reason when the preset's
/// values do not make a footprint.
Result<ActuationScene> scene_of(const preset::Preset& preset);

/// The meshes that nest in one of `edges` a segment, down to four edges, itself the last: alone, its
/// error is not known.
LevelPlan plan_of_mesh(int edges);

}  // namespace gridshell::experiment
