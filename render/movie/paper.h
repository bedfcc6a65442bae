// The paper of sheets for the workshop and of reports.
#pragma once

#include <string>
#include <vector>

#include "render/canvas/canvas.h"

namespace gridshell::render {

/// A sheet of A4 and its margin, and the width of its text, points.
inline constexpr double a4_width = 595.28, a4_height = 841.89, a4_margin = 42;
inline constexpr double text_width = a4_width - 2 * a4_margin;

/// The colour of what is hard to build.
inline constexpr Colour alarm_red{0.7f, 0.1f, 0.1f, 1};

/// Breaks text into lines before a sheet exists.
std::vector<std::string> lines_of(const std::string& text, double width, const TextStyle& style);

}  // namespace gridshell::render
