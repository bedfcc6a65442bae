// A run read back from its folder, finished or cut short.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/cli/pictures.h"
#include "engine/gridshell.h"

namespace gridshell::app {

/// One run folder. Of a run that was cut short the trajectory ends with the last whole frame, and
/// the summary, which says so, speaks of that.
struct FinishedRun {
  std::string name;  ///< of the case, empty without cases
  preset::Preset preset;
  record::Trajectory trajectory;
  record::Summary summary;
  record::StateTables states = {};  ///< of a search for states
  Pictures pictures = Pictures::movie;
  bool in_journal = false;  ///< its files are still to be made of its journal
};

/// All runs of a folder: itself, or its cases. What stands in it may come from anybody. Errors:
/// bad_input naming file and cause.
Result<std::vector<FinishedRun>> read_runs(const std::filesystem::path& folder,
                                           const std::vector<preset::Override>& overrides,
                                           bool unsealed);

/// "41 frames, up to progress 0.17" of a run that was cut short.
std::string progress_text(const FinishedRun& run);

}  // namespace gridshell::app
