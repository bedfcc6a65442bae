// The net that a preset asks for on a surface given by an expression.
#pragma once

#include "engine/scene/net_design.h"

namespace gridshell {

/// F(x, y, z) = 0 or z = h(x, y), from an apex where the surface faces up, as far as the boundary;
/// the net's grid is an eighth of the rods' spacing. Errors (bad_input): an expression that does
/// not parse, an apex off the surface or outside the boundary, and those of the net and its part.
Result<NetDesign> surface_design(const preset::Net& wanted, double spacing_mm);

}  // namespace gridshell
