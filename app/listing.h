// What the program has, for other programs: `gridshell list --json`.
#pragma once

#include <string>

#include "engine/core/result.h"

namespace gridshell::app {

/// One object: `version`; `commands`, each with its options; `presets` with title, description and
/// source; `tables` and `keys`, each with table, unit, default (as TOML), allowed and meaning.
/// Errors: a preset that came with the program does not read.
Result<std::string> listing_json();

}  // namespace gridshell::app
