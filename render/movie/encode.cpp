#include "render/movie/encode.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include "engine/core/atomic_file.h"
#include "render/movie/child.h"

namespace gridshell::render {

std::vector<std::string> encode_arguments(const std::filesystem::path& frames, int fps,
                                          const std::filesystem::path& movie) {
  // in the pattern a percent sign of the folder's own name is doubled
  std::string pattern;
  for (char c : frames.string()) pattern += c == '%' ? std::string("%%") : std::string(1, c);
  // ffmpeg takes what stands before a colon for a protocol, and a leading dash for an option
  return {"ffmpeg",
          "-nostdin",
          "-y",
          "-loglevel",
          "error",
          "-framerate",
          std::to_string(fps),
          "-i",
          "file:" + pattern + "/frame_%05d.png",
          "-vf",
          "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white",
          "-c:v",
          "libx264",
          "-crf",
          "18",
          "-pix_fmt",
          "yuv420p",
          "-movflags",
          "+faststart",
          "file:" + movie.string()};
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    const bool harmless =
        !word.empty() && word.find_first_not_of(
                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                             "0123456789_-+=./:,%@") == std::string::npos;
    std::string quoted = "'";
    for (char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += (line.empty() ? "" : " ") + (harmless ? word : quoted + "'");
  }
  return line;
}

std::filesystem::path find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path file = std::filesystem::path(folder.empty() ? "." : folder) / name;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0)
      return file;
  }
  return {};
}

Result<Encoding> encode_movie(const std::filesystem::path& frames, int fps,
                              const std::filesystem::path& movie, const Watch& watch) {
  Encoding encoding{false, shell_line(encode_arguments(frames, fps, movie))};
  const std::filesystem::path program = find_program("ffmpeg");
  if (program.empty()) return encoding;
  AtomicFile file(movie);
  std::vector<std::string> arguments = encode_arguments(frames, fps, file.temporary());
  arguments[0] = program.string();
  if (auto run = run_child(arguments, watch); !run) {
    auto error = run.error();
    if (error.fault == Fault::io)
      error.message = fmt::format(
          "cannot make '{}' of the frames in '{}', which are whole: {} (ffmpeg takes pictures of "
          "less than 16384 x 16384 pixels; a smaller --size needs less memory too)",
          movie.string(), frames.string(), error.message);
    return tl::unexpected(error);
  }
  if (auto placed = file.commit(); !placed) return tl::unexpected(placed.error());
  encoding.made = true;
  return encoding;
}

}  // namespace gridshell::render
