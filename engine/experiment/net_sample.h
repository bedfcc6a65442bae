// The `net` rung: the smooth Chebyshev net itself, sampled at the rods.
#pragma once

#include "engine/experiment/actuation.h"

namespace gridshell::experiment {

/// What a gridshell's joints are away from their net, as a rule and over rho: caps of a sphere with
/// pinned ends lie within 0.032 of it.
constexpr double net_error = 0.032;

/// The flat footprint and the net, where `progress` has 0 and 1; nothing in between, as no
/// equilibrium is solved for. Residual, energies, pivots and error estimate are not known. Errors
/// (bad_input): those of the net.
Result<ActuationOutcome> sample_net(const ActuationScene& scene,
                                    const std::vector<double>& progress, Watch& watch);

}  // namespace gridshell::experiment
