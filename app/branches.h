// The work behind `chart branches`: a bifurcation diagram, its table and picture.
#pragma once

#include "app/charts.h"
#include "engine/core/watch.h"

namespace gridshell::app {

/// Writes branches.csv and branches.png, .svg, .pdf of a preset into `folder`; what to tell on the
/// terminal and in summary.json. Errors: those of the study, naming the reason, and io.
Result<Findings> draw_branches(const preset::Preset& preset, const std::filesystem::path& folder,
                               Watch& watch);

}  // namespace gridshell::app
