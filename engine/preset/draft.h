// A preset while its file is read, and what its keys say together once all are laid.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/preset/place.h"
#include "engine/preset/preset.h"

namespace gridshell::preset {

/// A preset on its way, and where each of its keys was set.
struct Draft {
  Preset preset;
  std::map<std::string, Place> set_at;  ///< by bracketed name
  std::set<std::string> faulty;         ///< keys whose value was refused
};

/// How a fault calls a key; `item` counts the tables of a list from 0.
std::string bracketed(const std::string& table, const std::string& key, int item = -1);

/// Values that do not agree with each other; where none of them was set the fault is in `source`.
void check_conflicts(const Draft& draft, const std::string& source, PlacedFaults& faults);

/// Keys that count for nothing in any of the runs of a file, because of what others are set to.
void check_use(const std::vector<Draft>& runs, PlacedFaults& faults);

}  // namespace gridshell::preset
