// The rods, joints and loads of a scene from those of its preset.
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/preset/preset.h"
#include "engine/scene/scene.h"

namespace gridshell {

/// The properties of every rod of the footprint: those of [rod] or [rod_v], of the file of a
/// network, with the diameters of `[rod] table`. Errors (bad_input): as of put_rods().
Result<std::vector<preset::Rod>> rods_of(const preset::Preset& preset, const Footprint& footprint);

/// Sets the rods, joints and loads of a scene from its preset. Errors (bad_input): a load on a
/// joint that does not exist, a diameter for a rod that does not exist.
Result<void> put_rods(const preset::Preset& preset, Scene& scene);

/// Sets the natural shapes of a network's rods, and the joints with laws of their own. Errors
/// (bad_input): a law at a point where no rods are joined, rods that do not cross there.
Result<void> put_laws(const preset::Preset& preset, Scene& scene);

/// Marks the joints on which an edge of every rod is centred: those that connect rods by a law, now
/// or after a step adds bolts.
void centre_edges(const preset::Preset& preset, Scene& scene);

}  // namespace gridshell
