// The manual page.
#pragma once

#include <string>

#include "engine/core/result.h"

namespace gridshell::app {

/// gridshell(1) in roff: commands with their options, presets, all keys. Errors: a preset that came
/// with the program does not read.
Result<std::string> man_page();

}  // namespace gridshell::app
