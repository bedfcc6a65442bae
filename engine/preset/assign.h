// Puts a TOML value into a preset's field, or says in a sentence why it cannot.
#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <string>

#include "engine/preset/field.h"

namespace gridshell::preset {

/// Empty when `value` was put into `preset`; else what is wrong and what is allowed, and `preset`
/// is as it was. Files of points are looked for in `folder`.
std::string assign(const Field& field, const toml::node& value, Preset& preset,
                   const std::filesystem::path& folder);

/// The value as a fault shows it: TOML on one line, shortened when long.
std::string shown(const toml::node& value);

}  // namespace gridshell::preset
