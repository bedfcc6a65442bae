// Frames to movie.mp4, by ffmpeg where it is on the PATH.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"

namespace gridshell::render {

/// Whether the movie was made, and the line for a shell that makes it.
struct Encoding {
  bool made = false;
  std::string command;
};

/// The arguments that turn `frames`/frame_%05d.png into `movie`, to be run in any folder: H.264
/// with 4:2:0 colours, which every player knows; an odd size is padded by a pixel.
std::vector<std::string> encode_arguments(const std::filesystem::path& frames, int fps,
                                          const std::filesystem::path& movie);

/// Words as one line that a POSIX shell reads back as the same words.
std::string shell_line(const std::vector<std::string>& words);

/// Where a program is on the PATH; empty if nowhere.
std::filesystem::path find_program(const std::string& name);

/// Runs ffmpeg on `frames` and puts `movie` in place once it is whole. Without ffmpeg that is no
/// error: `made` is false and `command` says how. Errors: Fault::io with ffmpeg's last words when
/// it failed, Fault::cancelled.
Result<Encoding> encode_movie(const std::filesystem::path& frames, int fps,
                              const std::filesystem::path& movie, const Watch& watch);

}  // namespace gridshell::render
