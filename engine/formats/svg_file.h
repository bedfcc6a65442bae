// Reads the shapes of an SVG as polylines in one plane.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/formats/outline_file.h"

namespace gridshell::preset {

/// Reads path (all commands), polygon, polyline, line, rect (with sharp corners), circle and
/// ellipse, with their transforms and those of their groups, y upwards. Shapes in defs, symbol,
/// clipPath, mask, marker, pattern or metadata, or with display="none", are ignored. The unit is
/// the width over the width of the viewBox; if the width has no unit, pixels of 1/96 inch. Errors
/// (bad_input), with `name` and the line: no svg, a tag that does not end, an invalid number or
/// command.
Result<PlanDrawing> read_svg(std::string_view bytes, const std::string& name);

}  // namespace gridshell::preset
