// Which keys of a preset count for nothing, because of the kind that another key chooses.
#pragma once

#include <string>
#include <vector>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// A key that nothing reads in this preset.
struct IdleKey {
  std::string table, key;
  int item = -1;                      ///< of a list of tables, from 0
  std::vector<std::string> deciders;  ///< the keys that make it so, "[net] kind"
  std::string why;                    ///< "only a spool or beltrami net has one"
};

/// Every key that this preset's kinds do not use. The reader refuses those that are set to
/// something, the writer leaves them out.
std::vector<IdleKey> idle_keys(const Preset& preset);

}  // namespace gridshell::preset
