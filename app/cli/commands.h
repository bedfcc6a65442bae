// The commands of the program: add_x declares the arguments of `gridshell x` and what
// it does.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/command_line.h"
#include "engine/gridshell.h"

namespace gridshell::app {

/// What `gridshell view` was given; empty or zero if nothing was.
struct ViewOptions {
  std::string input, record, play, shot, picture, size, quality = "movie", context = "auto";
  std::filesystem::path output = "out", workspace;
  bool bare = false;
  double bench = 0;
};

/// Functions that only gridshell_window has; in `gridshell` they are null, and it starts
/// gridshell_window instead.
struct WindowProgram {
  Result<int> (*view)(ViewOptions options) = nullptr;
  Result<std::string> (*man_page)() = nullptr;
};

/// Replaces this process by gridshell_window, from the same folder, with the same arguments.
/// Returns only if that fails. Errors: io.
Result<int> start_window_program(const CommandLine& program);

void add_render(CommandLine& program);
void add_view(CommandLine& program, Result<int> (*view)(ViewOptions options));
void add_chart(CommandLine& program);
void add_sweep(CommandLine& program);
void add_export(CommandLine& program);
void add_load(CommandLine& program);
void add_modes(CommandLine& program);
void add_report(CommandLine& program);
void add_scan(CommandLine& program);
void add_compare(CommandLine& program);

/// Validates a preset and prints what would run; returns the exit code.
Result<int> check(const Options& options);

/// Checks that the results requested from a sweep are results of a run. Errors (bad_input), with
/// the list of results.
Result<void> check_sweep(const preset::Presets& presets);

/// Designs the shell of a preset and writes its folder. Prints the result; returns the exit code.
Result<int> produce_design(const Options& options);

/// Writes a preset with `[ends] table` and `[rod] table`, if it has them, in STEM_ends.csv and
/// STEM_rods.csv in the same folder. Errors: io.
Result<void> write_preset_with_tables(const preset::Preset& preset,
                                      const std::filesystem::path& file);

/// What a shell can be exported as.
struct ExportFormat {
  std::string ending;   ///< of the file: ".vtp"
  std::string thing;    ///< shape, footprint or sheet
  std::string read_by;  ///< "ParaView"
};

/// The formats that `export` chooses by the ending of a file, without --what.
std::vector<ExportFormat> usual_exports();

/// Adds all commands, in the order of the help.
void add_commands(CommandLine& program, const WindowProgram& window = {});

/// main() of a program: reads the command line, runs one command, returns its exit code.
int run_program(int argc, char** argv, const WindowProgram& window = {});

/// All commands as data.
std::vector<CommandEntry> command_table();

// Commands, presets and keys as text. Errors: a preset of the program cannot be read.

/// One object: `version`; `commands`, each with its options; `presets` with title, description and
/// source; `tables` and `keys`, each with table, unit, default (as TOML), allowed and meaning.
Result<std::string> listing_json();

/// A script for bash that completes command lines: commands, options and their words, names of
/// presets, keys after --set; files and folders elsewhere.
std::string bash_completion();

}  // namespace gridshell::app
