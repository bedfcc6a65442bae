// The work behind `movie`, `figure` and `run`: every run of a preset simulated, written and drawn.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/cli/pictures.h"
#include "engine/gridshell.h"

namespace gridshell::app {

/// Simulates a preset and draws it. Prints what it came to; the exit code.
Result<int> produce(const Options& options, Pictures pictures);

/// How a run fell short of an equilibrium at the end of its path, stable unless that is allowed;
/// empty when it did not.
std::string failure_of(const record::Summary& summary, bool allow_unstable);

}  // namespace gridshell::app
