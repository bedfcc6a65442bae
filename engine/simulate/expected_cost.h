// Expected memory and time of a run, and the expected bending of its rods, before any mesh is
// built.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/footprint/footprint.h"
#include "engine/preset/preset.h"
#include "engine/scene/scene.h"
#include "engine/solve/mesh_levels.h"

namespace gridshell {

/// Largest memory of a run on these meshes, GB, for all of them and their factors together.
double memory_GB(const Footprint& footprint, RodModel rod_model, const LevelPlan& plan);

/// Checks the memory against [accuracy] memory_GB, by default half of the machine's. Errors:
/// bad_input with the requested mesh, its memory and the available memory.
Result<void> fits_memory(const Scene& scene, const LevelPlan& plan);

}  // namespace gridshell

namespace gridshell::simulate {

/// Number of unknowns of the mesh with `edges_per_segment`; 0 if nothing is solved.
int dof_of(const Scene& scene, int edges_per_segment);

/// Seconds of one core on the initial meshes of the run. Shells with snaps, whose meshes are chosen
/// during the run, take up to about four times that; snaps computed in time take more.
double expected_seconds(const Scene& scene, const preset::Preset& preset);

/// "strain about 0.0026, 0.9 of the rods' strength, of u+3, as the net is curved": the strain that
/// the net or the boundary imposes on the rods with the largest bending; for rods between
/// prescribed ends only the least possible. Empty: none, or rods with natural curvature.
std::string expected_bending(const Scene& scene);

/// Memory of the complete program, GB, if its meshes take `meshes_GB`.
double expected_GB(double meshes_GB, const preset::Preset& preset);

}  // namespace gridshell::simulate
