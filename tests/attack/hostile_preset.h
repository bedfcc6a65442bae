// Presets as somebody would write them who wants to break the program.
#pragma once

#include <string>

#include "tests/attack/trials.h"

/// A preset that comes with the program, changed in one to three respects: numbers scaled, values
/// extreme, of another type, not numbers or in contradiction, keys in wrong tables or twice, tables
/// and cases without end, deep nesting, long words, text that is no TOML or no text.
std::string hostile_preset(Draw& draw);
