// A run read back from its folder, finished or cut short.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/pictures.h"

namespace gridshell::app {

/// All runs of a folder: itself, or its cases. What stands in it may come from anybody. Of a run
/// that was cut short the trajectory ends with the last whole frame, and the summary, which says
/// so, speaks of that. Errors: bad_input naming file and cause.
Result<std::vector<Run>> read_runs(const std::filesystem::path& folder,
                                   const std::vector<preset::Override>& overrides, bool unsealed);

/// "41 frames, up to progress 0.17" of a run that was cut short.
std::string progress_text(const Run& run);

}  // namespace gridshell::app
