// The first buckled equilibrium out of the flat.
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

/// Mean shortening of the rods with their ends at the motion's t: 1 - sum |chord| / sum length.
double mean_shortening(const RodMesh& mesh, const PinnedMotion& motion, double t);

/// The path parameter at which the mean shortening is `shortening` (may lie beyond 1: the motion
/// goes on). Errors (bad_input) when the motion never shortens the rods that far.
Result<double> parameter_of_shortening(const RodMesh& mesh, const PinnedMotion& motion,
                                       double shortening);

/// A stable equilibrium at t, from the seed's shape: a dome as high as the shortening asks for,
/// tilted along a diagonal, brought to rest with EA scaled by 0.01 and then as it is. Errors:
/// no_equilibrium, cancelled.
Result<State> first_buckled(Linearisation& system, const RodMesh& mesh, const PinnedMotion& motion,
                            double t, const BuckleSeed& seed, const FlatFrame& flat,
                            const Watch& watch);

/// Rods that hang on two hinges at most: round, each may turn about the line between them without
/// any force, and buckles to any side.
std::vector<std::size_t> turning_rods(const Footprint& footprint);

/// The flat footprint as a state, at the begin of a motion: no rod is bent, every first director
/// stands up; ghosts and supports of springs are where the motion begins.
State flat_state(const Model& model, const RodMesh& mesh, const PinnedMotion& motion,
                 const FlatFrame& flat);

}  // namespace gridshell
