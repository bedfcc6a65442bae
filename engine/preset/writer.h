// Writes presets as text: as TOML that runs again, and as the reference of all keys.
#pragma once

#include <string>
#include <vector>

#include "engine/preset/reader.h"

namespace gridshell::preset {

/// Every key that counts for something in this preset, with value, unit and meaning: what it reads
/// back as does the same.
std::string to_toml(const Preset& preset);

/// The base as above, then a [[case]] each with the keys in which it differs from the base.
std::string to_toml(const Presets& presets);

/// A key as the reference shows it: all in words.
struct KeyText {
  std::string table;  ///< empty at the top of the file
  std::string key, unit;
  std::string value;    ///< its default, as TOML
  std::string allowed;  ///< "at least 0"
  std::string meaning;
};

/// All of them, in the order of the reference.
std::vector<KeyText> key_texts();

/// The reference of all keys: a Markdown table of key, unit, default, allowed values and meaning
/// for each table of the file.
std::string reference_markdown();

}  // namespace gridshell::preset
