// Fonts, colours and distances of the interface.
#pragma once

#include <imgui.h>

#include "engine/core/result.h"

namespace gridshell::ui {

/// Loads the text font (DejaVu Sans: it has □, ρ, δ and Δ) at so many pixels a point of text.
/// Errors: io when the system has none.
Result<void> load_fonts(double density);

/// Light or dark.
void choose_colours(bool dark, double density);

/// Red of what is wrong or not stable, green of what holds, amber of what lacks something, grey of
/// what is said beside.
ImU32 bad_ink(bool dark);
ImU32 good_ink(bool dark);
ImU32 doubt_ink(bool dark);
ImU32 pale_ink(bool dark);

}  // namespace gridshell::ui
