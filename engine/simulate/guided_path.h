// A path whose choices finer meshes made, followed on the meshes that its tolerance takes.
#pragma once

#include "engine/simulate/equilibrium_path.h"

namespace gridshell::simulate {

/// Follows `path` anew on its own meshes along an actuation that finer meshes confirmed: each
/// branch from where `guide` begins it, brought to these meshes, and from where the guide goes on
/// beyond a leap. Events are the guide's. False: somewhere these meshes have no such branch, or
/// lose it on its way, or their estimates do not keep within `allowed_mm`; the path is then of no
/// use. It is not asked of paths in several motions, with joints held, or with snaps
/// in time.
bool follow_guide(EquilibriumPath& path, const EquilibriumPath& guide, double allowed_mm,
                  const Watch& watch);

/// Whether the meshes of a simulation have the states of a path's last segment at its begin, in its
/// middle and at its end: stable, and beside those that are brought to them.
bool has_states_of(Simulation& simulation, const EquilibriumPath& path, const Watch& watch);

/// A way on which no state has a negative pivot.
bool stable(const PathSegment& segment);

/// Whether a path is one on which nothing happened: all of it stable, without an event, to its end.
bool uneventful(const EquilibriumPath& path);

/// Whether both stand beside one another where they begin.
bool begin_alike(const EquilibriumPath& a, const EquilibriumPath& b);

}  // namespace gridshell::simulate
