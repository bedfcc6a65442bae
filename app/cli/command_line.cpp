#include "app/cli/command_line.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "app/cli/console.h"
#include "engine/core/file_io.h"
#include "engine/core/system_info.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "render/gl/context.h"

namespace gridshell::app {
namespace {

/// An error with similar names if `word` is no command; else empty. CLI11 would only report that it
/// was "not expected".
std::string no_such_command(const CLI::App& program, const std::string& word) {
  std::vector<std::string> names;
  for (const auto* command : program.get_subcommands({})) names.push_back(command->get_name());
  if (std::ranges::find(names, word) != names.end()) return "";
  return "no command '" + word + "'" + did_you_mean(word, names) +
         " ('gridshell --help' lists them)";
}

/// The words of a choice, from the name of its type: "TEXT:{auto,osmesa}".
std::vector<std::string> words_in(const std::string& type) {
  const auto begin = type.find('{'), end = type.find('}');
  if (begin == type.npos || end == type.npos || end < begin) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

CommandOption entry_of(const CLI::Option& option) {
  CommandOption entry;
  entry.argument = option.get_positional();
  entry.name = entry.argument ? option.get_name(true) : option.get_name();
  if (!entry.argument && !option.get_lnames().empty()) entry.name = "--" + option.get_lnames()[0];
  if (!option.get_snames().empty()) entry.short_name = "-" + option.get_snames()[0];
  entry.meaning = option.get_description();
  entry.words = words_in(option.get_type_name());
  entry.flag = option.get_items_expected_max() == 0;
  entry.required = option.get_required();
  entry.many = option.get_items_expected_max() > 1;
  return entry;
}

}  // namespace

Argument Argument::required(bool must) { return option_->required(must); }
Argument Argument::in_range(int least, int most) { return option_->check(CLI::Range(least, most)); }
Argument Argument::in_range(double least, double most) {
  // every comparison with nan is false, so a range alone accepts it
  return option_->check(CLI::Range(least, most))->check([](const std::string& text) {
    return text.find("nan") == text.npos ? std::string() : text + " is no number";
  });
}
Argument Argument::one_of(const std::vector<std::string>& words) {
  return option_->check(CLI::IsMember(words));
}
Argument Argument::not_empty(const std::string& message) {
  return option_->check(
      [message](const std::string& text) { return text.empty() ? message : std::string(); });
}
Argument Argument::each(std::function<void(const std::string&)> act) {
  return option_->each(std::move(act));
}
Argument Argument::excludes(Argument other) { return option_->excludes(other.option_); }
Argument Argument::show_default() { return option_->capture_default_str(); }
Argument Argument::one_each_time() {
  return option_->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

template <class Value>
Argument CommandArguments::option(const std::string& names, Value& value,
                                  const std::string& meaning) {
  return command_->add_option(names, value, meaning);
}
template Argument CommandArguments::option(const std::string&, std::string&, const std::string&);
template Argument CommandArguments::option(const std::string&, std::filesystem::path&,
                                           const std::string&);
template Argument CommandArguments::option(const std::string&, std::vector<std::string>&,
                                           const std::string&);
template Argument CommandArguments::option(const std::string&, int&, const std::string&);
template Argument CommandArguments::option(const std::string&, double&, const std::string&);

Argument CommandArguments::flag(const std::string& names, bool& value, const std::string& meaning) {
  return command_->add_flag(names, value, meaning);
}
void CommandArguments::footer(const std::string& text) { command_->footer(text); }

CommandLine::CommandLine()
    : program_(std::make_unique<CLI::App>("Elastic gridshells: formed, measured and shown.",
                                          "gridshell")) {
  program_->set_version_flag("--version", version());
  program_->require_subcommand(1);
}

CommandLine::~CommandLine() = default;

CommandArguments CommandLine::add(const std::string& name, const std::string& meaning, Action act) {
  CLI::App* command = program_->add_subcommand(name, meaning);
  command->callback([this, act = std::move(act)] { action_ = act; });
  return command;
}

int CommandLine::run(int argc, char** argv) {
  given_ = argv;
  if (argc > 1 && argv[1][0] != '-')
    if (const auto fault = no_such_command(*program_, argv[1]); !fault.empty())
      return report({Fault::bad_input, fault});
  try {
    program_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 reports help and version as errors with code 0
    return program_->exit(error) == 0 ? ExitCode::done : ExitCode::bad_input;
  }
  return report(action_());
}

std::vector<CommandEntry> CommandLine::table() const {
  std::vector<CommandEntry> table;
  for (const CLI::App* command : program_->get_subcommands({})) {
    CommandEntry entry{command->get_name(), command->get_description(), command->get_footer(), {}};
    for (const CLI::Option* option : command->get_options())
      entry.options.push_back(entry_of(*option));
    table.push_back(std::move(entry));
  }
  return table;
}

void add_changes(CommandArguments command, Options& options) {
  command.option("--set", options.set, "a key of the preset, any number of times: table.key=value")
      .one_each_time();
  command.option("--size", options.size, "width and height of a picture: WxH");
  command.option("--quality", options.quality, "draft, movie or figure");
  command.option("--width", options.width, "width of a figure as printed: 85mm");
  command.option("--dpi", options.dpi, "pixels per inch, with --width");
  command.flag("--pdf", options.pdf, "stills as lines too, as PDF and SVG: figure.vector");
}

void add_preset_options(CommandArguments command, Options& options) {
  command.option("PRESET", options.input, "a preset file, or a name of 'gridshell list'")
      .required();
  add_changes(command, options);
  command.option("--frames", options.frames, "frames of the movie");
  command.flag("--print-config", options.print_config,
               "print the preset with its defaults and --set, as a preset, and stop");
}

void add_work_options(CommandArguments command, Options& options, const std::string& output) {
  command.option("-o,--output", options.output, output).not_empty("expected a folder");
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

void add_no_checksum(CommandArguments command, bool& no_checksum) {
  command.flag("--no-checksum,--unsealed", no_checksum,
               "take a trajectory.h5 that another program wrote or changed");
}

Result<std::vector<preset::Override>> overrides_of(const Options& options) {
  std::vector<preset::Override> overrides;
  for (const auto& argument : options.set) {
    TRY(change, preset::parse_override(argument));
    overrides.push_back(*change);
  }
  if (!options.frames.empty()) overrides.push_back({"--frames", "movie.frames", options.frames});
  // checked here, as it sets two keys and would be reported twice
  if (!options.quality.empty() && !find_word<preset::Quality>(options.quality))
    return invalid("--quality {}: expected draft, movie or figure", options.quality);
  if (!options.quality.empty())
    for (const char* key : {"movie.quality", "figure.quality"})
      overrides.push_back({"--quality", key, options.quality});
  if (!options.width.empty()) {
    const bool in_mm = options.width.ends_with("mm");
    const auto number = options.width.substr(0, options.width.size() - (in_mm ? 2 : 0));
    const auto width = parse_number<double>(number, std::chars_format::fixed);
    if (!in_mm || !width || !(*width > 0 && *width < 10000))
      return invalid("--width {}: expected millimetres above 0 and below 10000, for example 85mm",
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
  return invalid("--size {}: expected WxH, for example 1280x720", text);
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
                       change.key == "page.sweep" || change.key == "page.drawn";
    if (!shows || change.key == "movie.frames" || change.key == "figure.radii_mm")
      return invalid(
          "{}: {} cannot change once a run is finished; what can are keys of [movie], "
          "[style], [figure] and [page] that only show it",
          change.source, change.key);
  }
  return std::move(*overrides);
}

}  // namespace gridshell::app
