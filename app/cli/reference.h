// What the program has, for other programs: `gridshell list --json`.
#pragma once

#include <string>

#include "engine/core/result.h"

namespace gridshell::app {

/// One object: `version`; `commands`, each with its options; `presets` with title, description and
/// source; `tables` and `keys`, each with table, unit, default (as TOML), allowed and meaning.
/// Errors: a preset that came with the program does not read.
Result<std::string> listing_json();

// The manual page.

/// gridshell(1) in roff: commands with their options, presets, all keys. Errors: a preset that came
/// with the program does not read.
Result<std::string> man_page();
/// The same as a page for a browser, which needs no network.
Result<std::string> manual_html();

// Completion of command lines in bash.

/// A script for bash: commands, options and their words, names of presets, keys after --set; files
/// and folders elsewhere.
std::string bash_completion();

}  // namespace gridshell::app
