// Simulates, writes and draws every run of a preset, for `movie`, `figure` and `run`; reads runs
// back from their folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/command_line.h"
#include "app/cli/pictures.h"
#include "engine/gridshell.h"

namespace gridshell::app {

/// Draws RUN_turntable/movie.mp4 and its frames: the last state of a run, with a camera that turns
/// once around it in --frames frames, by default as many as a movie has. Returns the exit code.
/// Errors: bad_input, io, cancelled.
Result<int> turntable(const Options& options);

/// Simulates a preset and draws it. Prints the results; returns the exit code.
Result<int> produce(const Options& options, Pictures pictures);

/// Why a run is not what was requested: its path ended early, its last state is unstable and that
/// is not allowed, or the tolerance is not met. Empty if none of these is so.
std::string failure_of(const record::Summary& summary, bool allow_unstable);

/// All runs of a folder, finished or interrupted: the folder itself, or its cases. Its contents are
/// not trusted. The trajectory of an interrupted run ends with the last complete frame, and its
/// summary, which says so, describes that frame. Errors: bad_input with file and cause.
Result<std::vector<Run>> read_runs(const std::filesystem::path& folder,
                                   const std::vector<preset::Override>& overrides,
                                   bool no_checksum);

/// How far an interrupted run is: "41 frames, up to progress 0.17".
std::string progress_text(const Run& run);

}  // namespace gridshell::app
