// What a preset's keys must be to each other; each key on its own is held to its range by the
// reader.
#pragma once

#include <string>
#include <vector>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// Two keys that do not go together. The fault is shown where `key` was set.
struct Conflict {
  std::string table, key;
  std::vector<std::string> others;  ///< the other keys, "[table] key"
  std::string what;                 ///< what is wrong, what is allowed
  int item = -1;                    ///< of a list of tables, from 0
};

/// Empty when the preset makes sense as a whole (whether its footprint can be built is not known
/// here).
std::vector<Conflict> conflicts(const Preset& preset);

}  // namespace gridshell::preset
