// Every run of a preset simulated, written and drawn, the work behind `movie`, `figure` and `run`;
// and read back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/command_line.h"
#include "app/cli/pictures.h"
#include "engine/gridshell.h"

namespace gridshell::app {

/// The last state of a finished run as a movie in which the camera goes once around it, of
/// --frames or as many as a movie has: RUN_turntable/movie.mp4 and its frames. Errors: bad_input.
Result<int> turntable(const Options& options);

/// Simulates a preset and draws it. Prints the results; returns the exit code.
Result<int> produce(const Options& options, Pictures pictures);

/// How a run fell short of an equilibrium at the end of its path, stable unless that is allowed;
/// empty when it did not.
std::string failure_of(const record::Summary& summary, bool allow_unstable);

/// All runs of a folder, finished or interrupted: itself, or its cases. Its contents are not
/// trusted. The trajectory of an interrupted run ends with the last complete frame, and its
/// summary, which says so, describes that frame. Errors: bad_input with file and cause.
Result<std::vector<Run>> read_runs(const std::filesystem::path& folder,
                                   const std::vector<preset::Override>& overrides,
                                   bool no_checksum);

/// "41 frames, up to progress 0.17" of a run that was cut short.
std::string progress_text(const Run& run);

}  // namespace gridshell::app
