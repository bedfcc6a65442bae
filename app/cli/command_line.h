// The command line: how commands declare their arguments. Only command_line.cpp includes CLI11,
// since its header takes longer to compile than a command.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/gridshell.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gridshell::app {

/// What a command does; returns the exit code (console.h).
using Action = std::function<Result<int>()>;

/// An argument or an option that was declared.
class Argument {
 public:
  Argument(CLI::Option* option) : option_(option) {}
  Argument required(bool must = true);
  Argument in_range(int least, int most);
  Argument in_range(double least, double most);
  Argument one_of(const std::vector<std::string>& words);
  /// Refuses an empty text with `message`.
  Argument not_empty(const std::string& message);
  /// Calls `act` with each text that is given.
  Argument each(std::function<void(const std::string&)> act);
  Argument excludes(Argument other);
  /// Shows its default value in the help.
  Argument show_default();
  /// May be given any number of times, with one value each time.
  Argument one_each_time();

 private:
  CLI::Option* option_;
};

/// Declares arguments and options of a command; `names` is "-o,--output" for an option, "PRESET"
/// for an argument.
class CommandArguments {
 public:
  CommandArguments(CLI::App* command) : command_(command) {}
  /// `value`: a text or a list of texts, a path, an int or a double.
  template <class Value>
  Argument option(const std::string& names, Value& value, const std::string& meaning);
  Argument flag(const std::string& names, bool& value, const std::string& meaning);
  /// Sets the last paragraph of the help.
  void footer(const std::string& text);

 private:
  CLI::App* command_;
};

// The commands as data, for everything that lists them.

/// An argument or an option of a command.
struct CommandOption {
  std::string name;        ///< "--to"; of an argument "PRESET"
  std::string short_name;  ///< "-o", or empty
  std::string meaning;
  std::vector<std::string> words;  ///< its allowed values; empty: any text
  bool argument = false;           ///< has no option name
  bool flag = false;               ///< takes no value
  bool required = false;
  bool many = false;  ///< may be given any number of times
};

struct CommandEntry {
  std::string name, meaning;
  std::string footer;  ///< what its help ends with
  std::vector<CommandOption> options;
};

class CommandLine {
 public:
  CommandLine();
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Adds `gridshell name`, which does `act`.
  CommandArguments add(const std::string& name, const std::string& meaning, Action act);

  /// Adds a command that calls `act` with the struct in which its arguments are stored.
  template <class Kept, class Act>
  std::pair<CommandArguments, Kept&> add(const std::string& name, const std::string& meaning,
                                         Act act) {
    const auto kept = std::make_shared<Kept>();
    return {add(name, meaning, [kept, act] { return act(*kept); }), *kept};
  }

  /// Executes the command line and returns the exit code; errors are reported.
  int run(int argc, char** argv);
  /// The arguments of the program, as run() was given them, ended by a null pointer.
  char** given() const { return given_; }

  /// All commands, in the order of the help.
  std::vector<CommandEntry> table() const;

 private:
  std::unique_ptr<CLI::App> program_;
  Action action_;
  char** given_ = nullptr;
};

// Options that several commands have.

/// What was given on the command line; empty or zero if nothing was.
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
  bool turntable = false;
};

/// Adds PRESET, the options of add_changes(), --frames and --print-config.
void add_preset_options(CommandArguments command, Options& options);

/// Adds the options that change a preset or the pictures of a run: --set, --size, --quality,
/// --width, --dpi, --pdf.
void add_changes(CommandArguments command, Options& options);

/// Adds -o, --threads and --quiet, for commands that compute for long.
void add_work_options(CommandArguments command, Options& options,
                      const std::string& output = "folder to write, by default out/<preset>");

/// Adds --context, for commands that draw.
void add_picture_options(CommandArguments command, Options& options);

/// Adds `--no-checksum` (formerly `--unsealed`), for commands that read the trajectory of a run.
void add_no_checksum(CommandArguments command, bool& no_checksum);

/// The options that change the preset, in the order in which they are applied. Errors: bad_input
/// for a --set without key or value, an unknown --quality, a --width that is no length, a --size
/// that is not WxH.
Result<std::vector<preset::Override>> overrides_of(const Options& options);

/// The overrides for a finished run, of which only the presentation and the keys `also` may change.
/// Errors: bad_input for any other key.
Result<std::vector<preset::Override>> overrides_of_run(const Options& options,
                                                       const std::vector<std::string>& also = {});

/// The width and height that --size names. Errors (bad_input): not WxH.
Result<std::pair<int, int>> size_of(const std::string& text);

/// Writes a file, after creating its folder if that is missing. Errors: io.
Result<void> write_with_folder(const std::filesystem::path& file, const std::string& text);

/// The two whole numbers, of at most six digits each, that `between` separates in a text: 1280 and
/// 720 in "1280x720" if it is "x". Nothing for other texts.
std::optional<std::pair<int, int>> two_numbers(std::string_view text, std::string_view between);

}  // namespace gridshell::app
