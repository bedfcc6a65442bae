// A footprint from a file of rods, what holds it and where that goes.
#pragma once

#include "engine/core/result.h"
#include "engine/preset/preset.h"
#include "engine/scene/scene.h"

namespace gridshell {

/// Fills footprint, frame, motion and boundaries of a scene from `[footprint] file`. The flat frame
/// stands in the middle of the box around the rods. Supports go where the file says; ends of which
/// it says nothing to `[actuation] scale` times their place from the middle (0: they stay).
/// Boundaries are the convex hull of what is held. Errors (bad_input): those of
/// network_footprint().
Result<void> build_network(const preset::Preset& preset, Scene& scene);

}  // namespace gridshell
