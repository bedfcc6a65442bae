// Encoding of frames as a movie by ffmpeg, if it is on the PATH.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/file_io.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "render/gl/image.h"
#include "render/movie/movie_style.h"
#include "render/movie/subprocess.h"

namespace gridshell::render {

// The timing of a movie is given by these keys of [movie]: fps, frames, seconds, hold_first_s,
// hold_s and pace. With title_s the movie begins with a card, title.png next to the folder
// `frames`.

/// The arguments of ffmpeg that make `movie` from `frames`/frame_%05d.png, in any current folder.
/// The format is that of the extension: .mp4 is H.264 with 4:2:0 colours, which every player
/// supports, and tags with the colour space; .webm is VP9; .gif has a palette of its own. An odd
/// size is padded by a pixel.
std::vector<std::string> encode_arguments(const std::filesystem::path& frames,
                                          const preset::Movie& timing,
                                          const std::filesystem::path& movie);

/// Arguments as one line for a POSIX shell, quoted where necessary.
std::string shell_line(const std::vector<std::string>& words);

/// The path of a program on the PATH; empty if there is none.
std::filesystem::path find_program(const std::string& name);

/// Runs ffmpeg on `frames`; `movie` exists only when it is complete. Without ffmpeg nothing is
/// made. Errors: Fault::io with ffmpeg's last message if it failed, Fault::cancelled.
Result<void> encode_movie(const std::filesystem::path& frames, const preset::Movie& timing,
                          const std::filesystem::path& movie, const Watch& watch);

/// Encodes a movie while its frames are drawn. The file is equal to the bit to that of
/// encode_movie().
class MovieEncoder {
 public:
  /// Starts ffmpeg for pictures of timing.size; a title card must exist next to `frames` already.
  /// Empty without ffmpeg. Errors: Fault::io if it cannot start.
  static Result<std::optional<MovieEncoder>> begin(const std::filesystem::path& frames,
                                                   const preset::Movie& timing,
                                                   const std::filesystem::path& movie);

  /// Passes the next frame to ffmpeg. Errors are reported by finish(), so that the remaining frames
  /// are drawn nevertheless.
  void put(const Image& picture, const Watch& watch);

  /// Waits for ffmpeg and gives the movie its final name. Errors: those of encode_movie().
  Result<void> finish(const Watch& watch);

 private:
  MovieEncoder(std::filesystem::path frames, std::filesystem::path movie,
               std::unique_ptr<AtomicFile> file, Subprocess ffmpeg)
      : frames_(std::move(frames)),
        movie_(std::move(movie)),
        file_(std::move(file)),
        ffmpeg_(std::move(ffmpeg)) {}

  std::filesystem::path frames_, movie_;
  std::unique_ptr<AtomicFile> file_;
  Subprocess ffmpeg_;
  bool takes_more_ = true;
};

}  // namespace gridshell::render
