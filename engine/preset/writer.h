// Writes presets as text: as TOML that runs again, and as the reference of all keys.
#pragma once

#include <string>

#include "engine/preset/reader.h"

namespace gridshell::preset {

/// Every key that counts for something in this preset, with value, unit and meaning: what it reads
/// back as does the same.
std::string to_toml(const Preset& preset);

/// The base as above, then a [[case]] each with the keys in which it differs from the base.
std::string to_toml(const Presets& presets);

/// The reference of all keys: a Markdown table of key, unit, default, allowed values and meaning
/// for each table of the file.
std::string reference_markdown();

}  // namespace gridshell::preset
