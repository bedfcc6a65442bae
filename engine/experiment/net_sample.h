// The `net` rung: the smooth Chebyshev net itself, sampled at the rods.
#pragma once

#include "engine/core/watch.h"
#include "engine/record/sink.h"
#include "engine/scene/scene.h"

namespace gridshell::experiment {

/// What a gridshell's joints are away from their net, as a rule and over rho: caps of a sphere with
/// pinned ends lie within 0.032 of it.
constexpr double net_error = 0.032;

/// The flat footprint and the net, where `progress` has 0 and 1; nothing in between, as no
/// equilibrium is solved for. Residual, energies, pivots and error estimate are not known. Returns
/// the mesh that was drawn. Errors (bad_input): those of the net; the sink's.
Result<RodMesh> sample_net(const Scene& scene, const std::vector<double>& progress,
                           record::Sink& sink, Watch& watch);

}  // namespace gridshell::experiment
