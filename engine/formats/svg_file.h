// Reads the shapes of an SVG as polylines in one plane.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/formats/outline_file.h"

namespace gridshell::preset {

/// Reads path (all commands), polygon, polyline, line, rect (with sharp corners), circle and
/// ellipse, with their transforms and those of their groups, y upwards. Shapes in defs, symbol,
/// clipPath, mask, marker, pattern or metadata, or hidden by display or visibility (as attributes,
/// in style or by rules of <style> for a tag, a class or an id), are ignored. The unit is the width
/// over that of the viewBox, or height over height if that is smaller; without a viewBox, and for
/// lengths without a unit, it is a pixel of 1/96 inch. Errors (bad_input), with `name` and the
/// line: no svg, a tag that does not end, an invalid number, command or transform, a length in % or
/// of an unknown unit, an svg within an svg, rules of other selectors that may hide or move shapes.
Result<PlanDrawing> read_svg(std::string_view bytes, const std::string& name);

}  // namespace gridshell::preset
