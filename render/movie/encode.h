// Frames to a movie, by ffmpeg where it is on the PATH.
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

// How fast a movie of so many frames plays its preset says: fps, frames, seconds, hold_first_s,
// hold_s, pace, and title_s of the card before all, title.png next to the folder `frames`.

/// The arguments that turn `frames`/frame_%05d.png into `movie`, to be run in any folder. By its
/// extension: .mp4, H.264 with 4:2:0 colours, which every player knows, and tags that say which
/// colours these are; .webm, VP9; .gif with a palette of its own. An odd size is padded by a pixel.
std::vector<std::string> encode_arguments(const std::filesystem::path& frames,
                                          const preset::Movie& timing,
                                          const std::filesystem::path& movie);

/// Words as one line that a POSIX shell reads back as the same words.
std::string shell_line(const std::vector<std::string>& words);

/// Where a program is on the PATH; empty if nowhere.
std::filesystem::path find_program(const std::string& name);

/// Runs ffmpeg on `frames` and puts `movie` in place once it is whole; nothing is made without
/// ffmpeg. Errors: Fault::io with ffmpeg's last words when it failed, Fault::cancelled.
Result<void> encode_movie(const std::filesystem::path& frames, const preset::Movie& timing,
                          const std::filesystem::path& movie, const Watch& watch);

/// A movie that is made while its frames are drawn: the same file, to the bit, as encode_movie()
/// makes of them afterwards.
class MovieEncoder {
 public:
  /// Starts ffmpeg for pictures of timing.size; a title card is next to `frames` already.
  /// Nothing without ffmpeg. Errors: Fault::io when it cannot start.
  static Result<std::optional<MovieEncoder>> begin(const std::filesystem::path& frames,
                                                   const preset::Movie& timing,
                                                   const std::filesystem::path& movie);

  /// The next frame. What goes wrong finish() says: the pictures themselves are to be kept.
  void put(const Image& picture, const Watch& watch);

  /// Puts the movie in place once it is whole. Errors: as of encode_movie().
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
