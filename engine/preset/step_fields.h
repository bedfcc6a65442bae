// The keys of the field table that say what a hand does to a shell, step by step.
#pragma once

#include <vector>

#include "engine/preset/consistency.h"
#include "engine/preset/field.h"

namespace gridshell::preset {

std::vector<Field> step_fields();  ///< [[step]]

/// What of a preset's steps does not go together.
std::vector<Conflict> step_conflicts(const Preset& preset);

/// The deeds that a key of [[step]] is for; empty: all.
std::vector<Deed> deeds_of_key(const std::string& key);

}  // namespace gridshell::preset
