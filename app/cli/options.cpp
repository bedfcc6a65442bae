#include "app/cli/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "engine/core/file_io.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "render/gl/context.h"

namespace gridshell::app {

void add_changes(CommandArguments command, Options& options) {
  command.option("--set", options.set, "a key of the preset, any number of times: table.key=value")
      .one_each_time();
  command.option("--size", options.size, "width and height of a picture: WxH");
  command.option("--quality", options.quality, "draft, movie or figure");
  command.option("--width", options.width, "width of a figure as printed: 85mm");
  command.option("--dpi", options.dpi, "pixels of an inch, with --width");
  command.flag("--pdf", options.pdf, "stills as lines too, as PDF and SVG: figure.vector");
}

void add_preset_options(CommandArguments command, Options& options) {
  command.option("PRESET", options.input, "a preset file, or a name of 'gridshell list'")
      .required();
  add_changes(command, options);
  command.option("--frames", options.frames, "frames of the movie");
  command.flag("--print-config", options.print_config,
               "print what default < preset < --set came to, as a preset, and stop");
}

void add_work_options(CommandArguments command, Options& options, const std::string& output) {
  command.option("-o,--output", options.output, output).not_empty("must name a folder");
  command.option("--threads", options.threads, "threads to work with; results do not change")
      .in_range(1, 1024)
      // the software rasteriser reads this when its context is made
      .each([](const std::string& count) { setenv("LP_NUM_THREADS", count.c_str(), 1); });
  command.flag("--quiet", options.quiet, "print nothing but errors");
}

void add_picture_options(CommandArguments command, Options& options) {
  command.option("--context", options.context, "auto, osmesa, egl or window")
      .one_of(all_words<render::ContextKind>());
}

void add_unsealed(CommandArguments command, bool& unsealed) {
  command.flag("--unsealed", unsealed,
               "take a trajectory.h5 that another program wrote or changed");
}

Result<std::vector<preset::Override>> overrides_of(const Options& options) {
  std::vector<preset::Override> overrides;
  for (const auto& argument : options.set) {
    TRY(change, preset::parse_override(argument));
    overrides.push_back(*change);
  }
  if (!options.frames.empty()) overrides.push_back({"--frames", "movie.frames", options.frames});
  // one word for two keys is wrong once
  if (!options.quality.empty() && !find_word<preset::Quality>(options.quality))
    return fail(Fault::bad_input, "--quality {}: must be draft, movie or figure", options.quality);
  if (!options.quality.empty())
    for (const char* key : {"movie.quality", "figure.quality"})
      overrides.push_back({"--quality", key, options.quality});
  if (!options.width.empty()) {
    const auto number = options.width.substr(0, options.width.rfind("mm"));
    const auto width = parse_number<double>(number, std::chars_format::fixed);
    if (number == options.width || !width || !(*width > 0 && *width < 10000))
      return fail(
          Fault::bad_input,
          "--width {}: must be in millimetres, more than 0 and less than 10000, for example 85mm",
          options.width);
    overrides.push_back({"--width", "figure.width_mm", number});
  }
  if (!options.dpi.empty()) overrides.push_back({"--dpi", "figure.dpi", options.dpi});
  if (options.pdf) overrides.push_back({"--pdf", "figure.vector", "true"});
  if (!options.size.empty()) {
    TRY(size, size_of(options.size));
    overrides.push_back(
        {"--size", "movie.size", fmt::format("[{}, {}]", size->first, size->second)});
  }
  return overrides;
}

std::optional<std::pair<int, int>> two_numbers(std::string_view text, std::string_view between) {
  const auto at = text.find(between);
  if (at == text.npos) return std::nullopt;
  const auto number = [](std::string_view digits) {
    return digits.size() <= 6 ? parse_number<unsigned>(digits) : std::nullopt;
  };
  const auto first = number(text.substr(0, at)), second = number(text.substr(at + between.size()));
  if (!first || !second) return std::nullopt;
  return std::pair(int(*first), int(*second));
}

Result<std::pair<int, int>> size_of(const std::string& text) {
  if (const auto size = two_numbers(text, "x")) return *size;
  return fail(Fault::bad_input, "--size {}: must be WxH, for example 1280x720", text);
}

Result<void> write_with_folder(const std::filesystem::path& file, const std::string& text) {
  if (file.has_parent_path()) TRY_DO(make_folder(file.parent_path()));
  return write_file(file, text);
}

Result<std::vector<preset::Override>> overrides_of_run(const Options& options,
                                                       const std::vector<std::string>& also) {
  TRY(overrides, overrides_of(options));
  for (const auto& change : *overrides) {
    if (std::ranges::find(also, change.key) != also.end()) continue;
    const bool shows = change.key.starts_with("movie.") || change.key.starts_with("figure.") ||
                       change.key.starts_with("style.") || change.key == "page.photo" ||
                       change.key == "page.sweep";
    if (!shows || change.key == "movie.frames" || change.key == "figure.radii_mm")
      return fail(Fault::bad_input,
                  "{}: {} cannot change once a run is finished; what can are keys of [movie], "
                  "[style], [figure] and [page] that only show it",
                  change.source, change.key);
  }
  return std::move(*overrides);
}

}  // namespace gridshell::app
