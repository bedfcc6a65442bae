#include "engine/preset/preset.h"

namespace gridshell::preset {

Preset::Preset() = default;
Preset::~Preset() = default;
Preset::Preset(const Preset&) = default;
Preset::Preset(Preset&&) noexcept = default;
Preset& Preset::operator=(const Preset&) = default;
Preset& Preset::operator=(Preset&&) noexcept = default;

const std::string& title_or_name(const Preset& preset) {
  return preset.title.empty() ? preset.name : preset.title;
}

void add_item(Preset& preset, const std::string& table) {
  each_list([&](const char* name, auto member) {
    if (table == name) (preset.*member).emplace_back();
  });
}

Preset default_items() {
  Preset preset;
  each_list([&](const char*, auto member) { (preset.*member).emplace_back(); });
  return preset;
}

std::optional<int> items_of(const Preset& preset, const std::string& table) {
  std::optional<int> items;
  each_list([&](const char* name, auto member) {
    if (table == name) items = int((preset.*member).size());
  });
  return items;
}

}  // namespace gridshell::preset
