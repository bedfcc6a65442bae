// What a preset is called where people read it.
#pragma once

#include <algorithm>
#include <string>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// Its title, or where it has none its name.
inline const std::string& title_or_name(const Preset& preset) {
  return preset.title.empty() ? preset.name : preset.title;
}

// The tables of a preset that stand once an item, [[block]], [[join]] and [[step]], all at once.

/// Calls visit(name, member) for each of them, in the order of the file; `member` is that of
/// Preset.
template <class Visit>
void each_list(const Visit& visit) {
  visit("block", &Preset::block);
  visit("join", &Preset::join);
  visit("step", &Preset::step);
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

/// The preset with its lists ending at an item (from 0), which a field then speaks of; below 0: as
/// it is.
inline Preset lists_up_to(Preset preset, int item) {
  if (item < 0) return preset;
  each_list([&](const char*, auto member) {
    auto& list = preset.*member;
    list.resize(std::min(list.size(), std::size_t(item) + 1));
  });
  return preset;
}

}  // namespace gridshell::preset
