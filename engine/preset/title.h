// What a preset is called where people read it.
#pragma once

#include <string>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// Its title, or where it has none its name.
inline const std::string& title_or_name(const Preset& preset) {
  return preset.title.empty() ? preset.name : preset.title;
}

}  // namespace gridshell::preset
