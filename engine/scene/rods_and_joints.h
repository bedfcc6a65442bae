// From a preset's rods, joints and loads to those of the models.
#pragma once

#include "engine/core/result.h"
#include "engine/preset/preset.h"
#include "engine/scene/scene.h"

namespace gridshell {

/// Gives a scene's footprint the preset's rods, joints and loads. Errors (bad_input): a load on a
/// joint, a diameter of a rod that is not there.
Result<void> put_rods(const preset::Preset& preset, Scene& scene);

/// Sets the natural shapes of a network's rods, and the joints with laws of their own. Errors
/// (bad_input): a law at a point where no rods are joined, rods that do not cross there.
Result<void> put_laws(const preset::Preset& preset, Scene& scene);

/// Gives every rod an edge centred on joints that connect rods by a law, now or after a step adds
/// bolts.
void centre_edges(const preset::Preset& preset, Scene& scene);

}  // namespace gridshell
