// Long work that delivers a folder: staged, under one progress bar, stopped by Ctrl-C, and whole
// under its final name or not there at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/options.h"
#include "app/progress.h"

namespace gridshell::app {

/// Writes into `partial`; begins every phase it was announced with.
using Work = std::function<Result<void>(const std::filesystem::path& partial, Progress& progress)>;

/// Runs `work` into a staged folder and gives it the name `final_folder`. On failure, what was
/// finished stays under the partial name, and a line on stderr says so. The exit code.
int deliver(const std::filesystem::path& final_folder, const std::vector<Phase>& phases, bool quiet,
            const Work& work);

/// Cleans a folder that will not be finished: half-written files go, whole pictures and runs stay;
/// without any the folder goes too. A sentence that says what is left.
std::string leave_finished(const std::filesystem::path& partial);

}  // namespace gridshell::app
