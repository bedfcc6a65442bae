// The net that a preset asks for on a surface given by an expression or a file.
#pragma once

#include "engine/geometry/surface_net.h"
#include "engine/scene/net_design.h"

namespace gridshell {

/// F(x, y, z) = 0, z = h(x, y), heights over a grid or a mesh, from an apex where the surface faces
/// up, as far as the boundary; the net's grid is an eighth of the rods' spacing. Errors
/// (bad_input): an expression that does not parse, a mesh that is no smooth sheet, an apex off the
/// surface or outside the boundary, and those of the net and its part. `so_far`, where given, is
/// filled where the net ends too early.
Result<NetDesign> surface_design(const preset::Net& wanted, double spacing_mm,
                                 NetSoFar* so_far = nullptr);

}  // namespace gridshell
