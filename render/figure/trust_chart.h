// A study of trust as pictures: what came of the scenes of each kind, and errors beside estimates.
#pragma once

#include <vector>

#include "engine/record/trust.h"
#include "render/plot/canvas.h"
#include "render/plot/plot.h"

namespace gridshell::render {

/// Colour of a class; what would be silently wrong is warm and dark.
Colour trust_colour(record::TrustClass found);

/// One bar a kind, parted by class with the number of scenes in each part, and a legend below.
Result<void> write_trust_bars(const std::filesystem::path& stem,
                              const std::vector<record::TrustRow>& rows);

/// Error over estimate of the scenes that were judged, and the line above which an estimate was too
/// small.
Plot trust_plot(const std::vector<record::TrustRow>& rows);

}  // namespace gridshell::render
