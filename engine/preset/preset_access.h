// What a preset is called where people read it.
#pragma once

#include <optional>
#include <string>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// Its title, or where it has none its name.
inline const std::string& title_or_name(const Preset& preset) {
  return preset.title.empty() ? preset.name : preset.title;
}

// The tables of a preset that stand once an item, [[block]], [[join]], [[step]] and
// [[loads.case]], all at once.

/// Calls visit(name, member) for each of them, in the order of the file; `member` is that of
/// Preset.
template <class Visit>
void each_list(const Visit& visit) {
  visit("block", &Preset::block);
  visit("join", &Preset::join);
  visit("step", &Preset::step);
  visit("loads.case", &Preset::load_case);
}

/// One item more with its defaults, at the end of that list.
inline void add_item(Preset& preset, const std::string& table) {
  each_list([&](const char* name, auto member) {
    if (table == name) (preset.*member).emplace_back();
  });
}

/// A preset with one item of each: what an item is before a key of it is read.
inline Preset default_items() {
  Preset preset;
  each_list([&](const char*, auto member) { (preset.*member).emplace_back(); });
  return preset;
}

/// How many items that list has; empty: the table is none of these.
inline std::optional<int> items_of(const Preset& preset, const std::string& table) {
  std::optional<int> items;
  each_list([&](const char* name, auto member) {
    if (table == name) items = int((preset.*member).size());
  });
  return items;
}

}  // namespace gridshell::preset
