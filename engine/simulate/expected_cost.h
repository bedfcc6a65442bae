// What the meshes of a run take of the machine's memory and time, and how much it bends its rods,
// worked out before any is built.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/footprint/footprint.h"
#include "engine/preset/preset.h"
#include "engine/scene/scene.h"
#include "engine/solve/mesh_levels.h"

namespace gridshell {

/// Gigabytes that a run on these meshes takes at most, all of them and their factors at a time.
double memory_GB(const Footprint& footprint, RodModel rung, const LevelPlan& plan);

/// Whether that is within [accuracy] memory_GB, by default half of the machine's. Errors: bad_input
/// with what was asked for, what it would take, and what there is.
Result<void> fits_memory(const Scene& scene, const LevelPlan& plan);

}  // namespace gridshell

namespace gridshell::simulate {

/// Unknowns of the mesh of so many edges a segment; 0 where nothing is solved.
int dof_of(const Scene& scene, int edges_per_segment);

/// Seconds of one core on the meshes that the run begins with; shells with snaps, whose meshes are
/// only chosen on the way, take up to some four times that, snaps followed in time more.
double expected_seconds(const Scene& scene, const preset::Preset& preset);

/// "strain about 0.0026, 0.9 of the rods' strength, of u+3, as the net is curved": what net or
/// boundary ask of the rods that bend most; of rods between their ends no more than the least.
/// Empty: nothing, or of rods curved at rest.
std::string expected_bending(const Scene& scene);

/// Gigabytes of the whole program, its meshes taking `meshes_GB`.
double expected_GB(double meshes_GB, const preset::Preset& preset);

}  // namespace gridshell::simulate
