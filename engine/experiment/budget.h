// What the meshes of a run take of the machine's memory, worked out before any is built.
#pragma once

#include "engine/core/result.h"
#include "engine/footprint/footprint.h"
#include "engine/scene/scene.h"
#include "engine/solve/nested.h"

namespace gridshell::experiment {

/// Unknowns of a mesh with so many edges a segment, to within a few per cent.
double unknowns_of(const Footprint& footprint, preset::Rung rung, int edges_per_segment);

/// Gigabytes that a run on these meshes takes at most, all of them and their factors at a time.
double memory_GB(const Footprint& footprint, preset::Rung rung, const LevelPlan& plan);

/// Whether that is within [accuracy] memory_GB, by default half of the machine's. Errors: bad_input
/// with what was asked for, what it would take, and what there is.
Result<void> fits_memory(const Scene& scene, const LevelPlan& plan);

}  // namespace gridshell::experiment
