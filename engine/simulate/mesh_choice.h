// What happens on a path belongs to the shell, not to the mesh that led: it is looked for on a
// finer leader too.
#pragma once

#include <optional>
#include <string>

#include "engine/simulate/equilibrium_path.h"

namespace gridshell::simulate {

/// Whether two paths on different meshes tell the same: the same segments with the same events,
/// which lie near each other, to the same end. Otherwise a sentence says what they differ in.
std::optional<std::string> mesh_disagreement(const EquilibriumPath& coarse,
                                             const EquilibriumPath& fine);

/// Counts what `from`, which led to a path, took as the path's own.
void take_over(EquilibriumPath& path, const EquilibriumPath& from);

/// The way of a path followed with leading meshes of twice the edges; nothing: there is none, or
/// they do not fit the memory. Errors: cancelled.
Result<SharedPath> led_by_twice_the_edges(const Scene& scene, EquilibriumPath& path,
                                          const Follow& follow, const Watch& watch);

/// Whether a finer path takes the place of one that ended where its leader alone loses the branch:
/// it begins alike, meets nothing on its whole way, stable on its finest mesh, and is within the
/// tolerance.
bool settles(const EquilibriumPath& fine, const EquilibriumPath& path);

/// A path that began in a buckled state out of the flat, or on which something happened, followed
/// once more with leading meshes of twice the edges; `one_motion`, where nothing happened on it,
/// three of its states alone are looked for on them.
/// Where both tell the same, the events' places are extrapolated (the error falls fourfold), with
/// an error, and where the path turns back clearly later with the finer one, its path is kept;
/// where they do not, the finer one is asked against a still finer one, at most three times, unless
/// nothing happens on its whole way, stable on its finest mesh. What is confirmed without a doubt
/// is followed on the coarsest meshes tried that have it (guided_path.h). Where a leader was asked
/// for, its path is kept, and what a finer one does not confirm is said. What remains in doubt is
/// said. Errors: cancelled.
Result<SharedPath> confirm_on_finer_meshes(const Scene& scene, SharedPath path,
                                           const Follow& follow, const Watch& watch,
                                           bool one_motion);

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
