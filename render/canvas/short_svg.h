// Compression of Cairo's SVG.
#pragma once

#include <string>
#include <string_view>

namespace gridshell::render {

/// An SVG of the same picture with fewer bytes: coordinates to a hundredth of a unit, colours as
/// #rrggbb, no properties with their default value; successive strokes of one style, or fills of
/// one style, become one path. Only lines `<path style="…" d="…"[ transform="…"]/>` are changed.
std::string short_svg(std::string_view svg);

}  // namespace gridshell::render
