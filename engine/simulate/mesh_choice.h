// What the meshes of a run take of the machine's memory and time, worked out before any is built.
#pragma once

#include "engine/core/result.h"
#include "engine/footprint/footprint.h"
#include "engine/scene/scene.h"
#include "engine/simulate/equilibrium_path.h"
#include "engine/solve/mesh_levels.h"

namespace gridshell {

/// Unknowns of a mesh with so many edges a segment, to within a few per cent.
double unknowns_of(const Footprint& footprint, RodModel rung, int edges_per_segment);

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

/// "strain up to 0.0026 of u+3, as the net is curved: 0.9 of the rods' strength": what net or
/// boundary ask of the rods that bend most. Empty: nothing, or of rods curved at rest.
std::string expected_bending(const Scene& scene);

/// Gigabytes of the whole program, its meshes taking `meshes_GB`.
double expected_GB(double meshes_GB, const preset::Preset& preset);

// What happens on a path belongs to the shell, not to the mesh that led: it is looked for on a
// finer leader too.

/// Whether two paths on different meshes tell the same: the same segments with the same events,
/// which lie near each other, to the same end. Otherwise a sentence says what they differ in.
std::optional<std::string> mesh_disagreement(const EquilibriumPath& coarse,
                                             const EquilibriumPath& fine);

/// Of a path that ended where its leader alone loses the branch, the one with leading meshes of
/// twice the edges, where it begins alike, meets nothing on its whole way, stable on its finest
/// mesh, and is within the tolerance; else nothing. Errors: cancelled.
Result<SharedPath> settled_by_finer(const Scene& scene, SharedPath path, const Follow& follow,
                                    const Watch& watch);

/// A path that began in a buckled state out of the flat, or on which something happened, followed
/// once more with leading meshes of twice the edges.
/// Where both tell the same, the events' places are extrapolated (the error falls fourfold), with
/// an error, and where the path turns back clearly later with the finer one, its path is kept;
/// where they do not, the finer one is asked against a still finer one, at most three times, unless
/// nothing happens on its whole way, stable on its finest mesh. What is confirmed without a doubt
/// is followed on the coarsest meshes tried that have it (guided_path.h). Where a leader was asked
/// for, its path is kept, and what a finer one does not confirm is said. What remains in doubt is
/// said. Errors: cancelled.
Result<SharedPath> confirm_on_finer_meshes(const Scene& scene, SharedPath path,
                                           const Follow& follow, const Watch& watch);

/// A path on the meshes asked for that did not come to its end, followed once more without its
/// leading mesh, and again: the first that does, else the path as it was.
SharedPath led_by_finer(SharedPath path, const Follow& follow, const Watch& watch);

/// Why a path is on finer meshes than its tolerance takes by more than tenfold; empty: it is not.
std::string why_so_fine(const EquilibriumPath& path);

/// Places of events that one leader alone tells, or meshes coarser than the path's finest, looked
/// for on the last two meshes of the path: extrapolated from these, with an error that counts by
/// how much they move what leaders told. One mesh alone is followed beside one of twice the edges.
/// Of motions that are over they stay as they are.
void locate_on_meshes(EquilibriumPath& path, const Follow& follow, const Watch& watch);

}  // namespace gridshell::simulate
