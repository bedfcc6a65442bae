// Cairo's SVG in fewer bytes.
#pragma once

#include <string>
#include <string_view>

namespace gridshell::render {

/// The same picture: coordinates to a hundredth of a unit, colours as #rrggbb, without properties
/// that have their default value; strokes, and fills, of one style that follow each other are one
/// path. Only lines `<path style="…" d="…"[ transform="…"]/>` are changed.
std::string short_svg(std::string_view svg);

}  // namespace gridshell::render
