// What a run takes, said before it runs: from the meshes that its tolerance begins with and the
// time that one factorisation takes on this machine.
#pragma once

#include "engine/preset/preset.h"
#include "engine/scene/scene.h"

namespace gridshell::simulate {

/// Unknowns of the mesh of so many edges a segment; 0 where nothing is solved.
int dof_of(const Scene& scene, int edges_per_segment);

/// Seconds of one core. Shells on which nothing happens take 0.7 to 1.5 times that, those with
/// Seconds of one core on the meshes that the run begins with; shells with snaps, whose meshes are
/// only chosen on the way, take up to some four times that, snaps followed in time more.
double expected_seconds(const Scene& scene, const preset::Preset& preset);

/// Gigabytes of the whole program, its meshes taking `meshes_GB`.
double expected_GB(double meshes_GB, const preset::Preset& preset);

}  // namespace gridshell::simulate
