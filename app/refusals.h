// Pictures of what was refused.
#pragma once

#include <filesystem>

#include "engine/preset/reader.h"

namespace gridshell::app {

/// Of every run whose net ends before its boundary: `<folder>_refused.png`, .svg and .pdf (with
/// cases `<folder>_<case>_refused`), told on the error output.
void draw_refusals(const preset::Presets& presets, const std::filesystem::path& folder);

}  // namespace gridshell::app
