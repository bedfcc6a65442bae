// Puts a TOML value into a preset's field, or says in a sentence why it cannot.
#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <map>
#include <string>

#include "engine/preset/field.h"

namespace gridshell::preset {

/// Where the files lie that a preset names: in a folder, or with it in the program.
struct Beside {
  std::filesystem::path folder;
  const std::map<std::string, std::string>* built_in = nullptr;  ///< texts by name
};

/// Empty when `value` was put into `preset`; else what is wrong and what is allowed, and `preset`
/// is as it was. Files are looked for `beside` the preset.
std::string assign(const Field& field, const toml::node& value, Preset& preset,
                   const Beside& beside);

/// The value as a fault shows it: TOML on one line, shortened when long.
std::string shown(const toml::node& value);

}  // namespace gridshell::preset
