// Contents of an SVG: its shapes as polylines in one plane.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/formats/outline_file.h"

namespace gridshell::preset {

/// Reads path (all of its commands), polygon, polyline, line, rect (its corners sharp), circle and
/// ellipse, under the transforms that they and their groups have, y turned up. What is in defs,
/// symbol, clipPath, mask, marker or pattern, or has display="none", is not drawn. The unit is that
/// of the width over the viewBox; without one per pixel of 1/96 inch. Errors (bad_input), with
/// `name` and the line: no svg, a tag that does not end, a number or a command of a path that is
/// none.
Result<PlanDrawing> read_svg(std::string_view bytes, const std::string& name);

}  // namespace gridshell::preset
