// The manual of the program, made from the tables of commands, keys and actions.
#pragma once

#include <string>

#include "engine/core/result.h"

namespace gridshell::window {

/// gridshell(1) in roff: commands with their options, presets, what the window does, all keys.
/// Errors: a preset of the program cannot be read.
Result<std::string> man_page();

/// The manual as an HTML page that needs no network. Errors: as man_page().
Result<std::string> manual_html();

}  // namespace gridshell::window
