// The manual of the program as text: from the tables that the program itself goes by.
#pragma once

#include <string>

#include "engine/core/result.h"

namespace gridshell::window {

/// gridshell(1) in roff: commands with their options, presets, what the window does, all keys.
/// Errors: a preset that came with the program does not read.
Result<std::string> man_page();

/// The manual as a page for a browser, which needs no network.
Result<std::string> manual_html();

}  // namespace gridshell::window
