// The options that the commands share, declared once.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/cli/command_line.h"
#include "engine/gridshell.h"

namespace gridshell::app {

/// What was given on the command line; empty or zero where nothing was.
struct Options {
  std::string input;  ///< PRESET or RUN
  std::filesystem::path output;
  std::vector<std::string> set;
  int threads = 0;
  bool quiet = false;
  std::string context = "auto";
  std::string size, quality, frames, width, dpi;
  bool print_config = false;
  bool pdf = false;
  bool resume = false;
};

/// PRESET and everything that changes it: --set, --frames, --size, --quality, --print-config.
void add_preset_options(CommandArguments command, Options& options);

/// What changes a preset or the pictures of a run: --set, --size, --quality, --width, --dpi, --pdf.
void add_changes(CommandArguments command, Options& options);

/// -o, --threads, --quiet: of commands that work for a while.
void add_work_options(CommandArguments command, Options& options,
                      const std::string& output = "folder to write, by default out/<preset>");

/// --context: of commands that draw.
void add_picture_options(CommandArguments command, Options& options);

/// --unsealed: of commands that read a run's trajectory.
void add_unsealed(CommandArguments command, bool& unsealed);

/// The options that change the preset, in the order in which they are laid over it. Errors:
/// bad_input for a --set without key or value, a --size that is not WxH.
Result<std::vector<preset::Override>> overrides_of(const Options& options);

/// The same of a finished run, of which only how it is shown may change, and the keys `also`.
/// Errors: bad_input for any other key.
Result<std::vector<preset::Override>> overrides_of_run(const Options& options,
                                                       const std::vector<std::string>& also = {});

/// The width and height that --size names. Errors (bad_input): not WxH.
Result<std::pair<int, int>> size_of(const std::string& text);

/// Writes a file of the user's choice; the folder that it lies in is made. Errors: io.
Result<void> write_with_folder(const std::filesystem::path& file, const std::string& text);

/// The whole numbers of at most six digits in "1280x720", 'x' between them; nothing for other
/// texts.
std::optional<std::pair<int, int>> two_numbers(std::string_view text, std::string_view between);

}  // namespace gridshell::app
