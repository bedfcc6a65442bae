// The commands of the program: add_x declares the arguments of `gridshell x` and what
// it does.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/command_line.h"
#include "engine/gridshell.h"

namespace gridshell::window {
struct ExportFormat;
}

namespace gridshell::app {

void add_render(CommandLine& program);
void add_view(CommandLine& program);
void add_chart(CommandLine& program);
void add_sweep(CommandLine& program);
void add_export(CommandLine& program);
void add_load(CommandLine& program);
void add_modes(CommandLine& program);
void add_report(CommandLine& program);
void add_scan(CommandLine& program);
void add_compare(CommandLine& program);

/// Validates a preset and prints what would run; the exit code.
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

/// What `export` writes by a file's ending alone.
std::vector<window::ExportFormat> usual_exports();

/// All of them, in the order of the help.
void add_commands(CommandLine& program);

/// All commands as data.
std::vector<CommandEntry> command_table();

// What the program has, as text. Errors: a preset that came with the program does not read.

/// One object: `version`; `commands`, each with its options; `presets` with title, description and
/// source; `tables` and `keys`, each with table, unit, default (as TOML), allowed and meaning.
Result<std::string> listing_json();

/// gridshell(1) in roff: commands with their options, presets, all keys.
Result<std::string> man_page();
/// The manual as a page for a browser, which needs no network.
Result<std::string> manual_html();

/// A script for bash that completes command lines: commands, options and their words, names of
/// presets, keys after --set; files and folders elsewhere.
std::string bash_completion();

}  // namespace gridshell::app
