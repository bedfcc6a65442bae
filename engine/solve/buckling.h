// The first buckled equilibrium of a flat shell whose boundary moves.
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/elastic/shell_rods.h"
#include "engine/footprint/actuation.h"
#include "engine/footprint/footprint.h"
#include "engine/footprint/mesh.h"
#include "engine/solve/pinned_motion.h"

namespace gridshell {

/// Mean shortening of the rods if their ends move to t: 1 - sum |chord| / sum length, over the
/// parts of rods between prescribed points.
double mean_shortening(const RodMesh& mesh, const PinnedMotion& motion, double t);

/// The path parameter at which the mean shortening is `shortening`. It may exceed 1, since the
/// motion is extrapolated. Errors (bad_input) if the motion never shortens the rods by that much.
Result<double> parameter_of_shortening(const RodMesh& mesh, const PinnedMotion& motion,
                                       double shortening);

/// A stable equilibrium at t from the seed's shape, a dome of the height that corresponds to the
/// shortening, tilted along a diagonal. The energy is minimised with EA scaled by 0.01, then with
/// EA. Errors: no_equilibrium, cancelled.
Result<State> first_buckled(Linearisation& system, const RodMesh& mesh, const PinnedMotion& motion,
                            double t, const BuckleSeed& seed, const FlatFrame& flat,
                            const Watch& watch);

/// The flat footprint as a state at the start of a motion: straight rods, first directors vertical;
/// ghosts and supports of springs at the start of the motion.
State flat_state(const Model& model, const RodMesh& mesh, const PinnedMotion& motion,
                 const FlatFrame& flat);

}  // namespace gridshell
