// The part of a net on a surface that its boundary encloses.
#pragma once

#include <memory>

#include "engine/footprint/domain.h"
#include "engine/geometry/surface_net.h"

namespace gridshell {

/// Where `outside` is below zero on a net, as far as that is joined to the apex. Grid lines are cut
/// to round-off; pieces shorter than the net's grid may be overlooked. boundary() takes even polar
/// angles in (u, v). Errors (bad_input): a ray from the apex crosses the boundary more than once.
Result<std::unique_ptr<Domain>> part_of(std::shared_ptr<const SurfaceNet> net,
                                        Surface::Function outside);

}  // namespace gridshell
