// The work behind `movie`, `figure` and `run`: every run of a preset simulated, written and drawn.
#pragma once

#include <string>
#include <vector>

#include "app/options.h"
#include "app/pictures.h"
#include "engine/record/summary.h"

namespace gridshell::app {

/// Simulates a preset and draws it. The exit code; everything that is to be said has been said.
int produce(const Options& options, Pictures pictures);

/// How a run fell short of an equilibrium at the end of its path, stable unless that is allowed;
/// empty when it did not.
std::string shortcoming(const record::Summary& summary, bool allow_unstable);

/// The text of the summary.json on top of several cases: the preset's name, and every case's
/// summary after its `name`, which is its folder.
std::string summary_of_cases(const std::string& preset, const std::vector<std::string>& names,
                             const std::vector<record::Summary>& summaries);

}  // namespace gridshell::app
