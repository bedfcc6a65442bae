#include "render/movie/encode.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace gridshell::render {

namespace {

/// Duration of the frames, s; at least four seconds, unless there are few frames.
double seconds_of(const preset::Movie& timing) {
  constexpr double least_s = 4, longest_frame_s = 0.25;
  if (timing.seconds > 0) return timing.seconds;
  return std::max(double(timing.frames) / std::max(1, timing.fps),
                  std::min(least_s, longest_frame_s * timing.frames));
}

/// ffmpeg's filters for the times at which frames are shown.
std::string timing_filters(const preset::Movie& timing) {
  std::string filters;
  const bool eased = timing.pace == Pace::eased && timing.frames > 1;
  const double seconds = seconds_of(timing);
  if (eased) {
    // the inverse of 3 p^2 - 2 p^3: slow at both ends
    filters += fmt::format("setpts='(0.5-sin(asin(1-2*N/{})/3))*{:.6f}/TB',fps={},",
                           timing.frames - 1, seconds, timing.fps);
  } else if (timing.frames > 0 && std::abs(seconds * timing.fps - timing.frames) > 1e-6) {
    filters += fmt::format("setpts='N*{:.6f}/TB',fps={},", seconds / timing.frames, timing.fps);
  }
  if (timing.hold_first_s > 0 || timing.hold_s > 0)
    filters += fmt::format(
        "tpad=start_mode=clone:start_duration={:.3f}:stop_mode=clone:stop_duration={:.3f},",
        timing.hold_first_s, timing.hold_s);
  return filters;
}

/// ffmpeg's options for the format of the movie.
std::vector<std::string> output_options(const std::string& kind) {
  const std::vector<std::string> tags{"-colorspace", "bt709", "-color_primaries", "bt709",
                                      "-color_trc",  "bt709", "-color_range",     "tv"};
  std::vector<std::string> options;
  if (kind == ".webm") options = {"-c:v", "libvpx-vp9", "-crf", "28", "-b:v", "0", "-row-mt", "1"};
  if (kind == ".gif") return {"-loop", "0"};
  // this preset takes half the time of the default for the same size; crf 17 keeps it as sharp
  if (kind != ".webm")
    options = {"-c:v", "libx264", "-preset", "veryfast", "-crf", "17", "-movflags", "+faststart"};
  options.insert(options.end(), {"-pix_fmt", "yuv420p"});
  options.insert(options.end(), tags.begin(), tags.end());
  return options;
}

/// The arguments of ffmpeg; `input`: those of its first input, the frames.
std::vector<std::string> arguments_of(const std::vector<std::string>& input,
                                      const std::filesystem::path& frames,
                                      const preset::Movie& timing,
                                      const std::filesystem::path& movie) {
  const std::string kind = movie.extension().string(), rate = std::to_string(timing.fps);
  std::vector<std::string> words{"ffmpeg", "-nostdin", "-y", "-loglevel", "error"};
  words.insert(words.end(), input.begin(), input.end());
  const bool gif = kind == ".gif";
  std::string chain = "[0:v]" + timing_filters(timing) + "format=rgb24[run]", last = "run";
  if (timing.title_s > 0) {
    for (const char* word : {"-loop", "1", "-framerate"}) words.push_back(word);
    words.insert(words.end(), {rate, "-t", fmt::format("{:.3f}", timing.title_s), "-i",
                               "file:" + (frames.parent_path() / "title.png").string()});
    chain += ";[1:v]format=rgb24[card];[card][run]concat=n=2:v=1[all]";
    last = "all";
  }
  chain += ";[" + last + "]pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,";
  chain += gif ? "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=none"
               // from version 7 ffmpeg writes the tags of its filters, not the options below
               : "scale=out_color_matrix=bt709:out_range=tv,"
                 "setparams=color_primaries=bt709:color_trc=bt709";
  words.insert(words.end(), {"-filter_complex", chain});
  for (const std::string& option : output_options(kind)) words.push_back(option);
  words.push_back("file:" + movie.string());
  return words;
}

/// An error of ffmpeg with the files of the movie.
Error reported(Error error, const std::filesystem::path& frames,
               const std::filesystem::path& movie) {
  if (error.fault == Fault::io)
    error.message = fmt::format(
        "cannot make '{}' of the frames in '{}', which are complete: {} (ffmpeg takes pictures of "
        "less than 16384 x 16384 pixels; a smaller --size needs less memory too)",
        movie.string(), frames.string(), error.message);
  return error;
}

}  // namespace

std::vector<std::string> encode_arguments(const std::filesystem::path& frames,
                                          const preset::Movie& timing,
                                          const std::filesystem::path& movie) {
  // in ffmpeg's pattern a percent sign of the folder's name is doubled
  std::string pattern;
  for (char c : frames.string()) pattern += c == '%' ? std::string("%%") : std::string(1, c);
  // "file:", since ffmpeg reads text before a colon as a protocol and a leading dash as an option
  return arguments_of(
      {"-framerate", std::to_string(timing.fps), "-i", "file:" + pattern + "/frame_%05d.png"},
      frames, timing, movie);
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

Result<void> encode_movie(const std::filesystem::path& frames, const preset::Movie& timing,
                          const std::filesystem::path& movie, const Watch& watch) {
  const std::filesystem::path program = find_program("ffmpeg");
  if (program.empty()) return {};
  AtomicFile file(movie);
  std::vector<std::string> arguments = encode_arguments(frames, timing, file.temporary());
  arguments[0] = program.string();
  if (auto run = run_subprocess(arguments, watch); !run)
    return tl::unexpected(reported(run.error(), frames, movie));
  return file.commit();
}

Result<std::optional<MovieEncoder>> MovieEncoder::begin(const std::filesystem::path& frames,
                                                        const preset::Movie& timing,
                                                        const std::filesystem::path& movie) {
  const std::filesystem::path program = find_program("ffmpeg");
  if (program.empty()) return std::nullopt;
  auto file = std::make_unique<AtomicFile>(movie);
  std::vector<std::string> arguments =
      arguments_of({"-f", "rawvideo", "-pixel_format", "rgba", "-video_size",
                    fmt::format("{}x{}", timing.size[0], timing.size[1]), "-framerate",
                    std::to_string(timing.fps), "-i", "pipe:0"},
                   frames, timing, file->temporary());
  arguments[0] = program.string();
  auto ffmpeg = Subprocess::start(arguments, Input::fed);
  if (!ffmpeg) return tl::unexpected(reported(ffmpeg.error(), frames, movie));
  return MovieEncoder(frames, movie, std::move(file), std::move(*ffmpeg));
}

void MovieEncoder::put(const Image& picture, const Watch& watch) {
  takes_more_ = takes_more_ && ffmpeg_.feed(picture.rgba, watch);
}

Result<void> MovieEncoder::finish(const Watch& watch) {
  if (auto ended = ffmpeg_.end(watch); !ended)
    return tl::unexpected(reported(ended.error(), frames_, movie_));
  if (!takes_more_)
    return tl::unexpected(
        reported({Fault::io, "ffmpeg stopped reading frames without a message"}, frames_, movie_));
  return file_->commit();
}

}  // namespace gridshell::render
