#include "engine/preset/consistency.h"

#include "engine/preset/model_choice.h"
#include "engine/preset/preset_access.h"

namespace gridshell::preset {

std::vector<KeyFault> key_faults(const Preset& preset, RuleKind kind) {
  std::vector<KeyFault> found;
  const auto look = [&](const Field& field, int item) {
    for (const Rule& rule : field.rules) {
      if (rule.kind != kind) continue;
      auto what = rule.fault(preset, item);
      if (what.empty()) continue;
      found.push_back({field.table, field.key, item, {}, std::move(what)});
      for (const auto& other : rule.others)
        found.back().others.push_back(full_label(field.table, other, item));
      if (kind == RuleKind::unused) return;
    }
  };
  for (const Field& field : field_table()) {
    if (field.rules.empty()) continue;
    const auto items = items_of(preset, field.table);
    if (!items) look(field, -1);
    for (int item = 0; item < items.value_or(0); ++item) look(field, item);
  }
  return found;
}

std::vector<KeyFault> conflicts(const Preset& preset) {
  auto found = key_faults(preset, RuleKind::refused);
  for (auto& fault : model_conflicts(preset)) found.push_back(std::move(fault));
  return found;
}

std::vector<KeyFault> unused_keys(const Preset& preset) {
  return key_faults(preset, RuleKind::unused);
}

std::optional<NamedSide> side_named(const Preset& preset, const std::string& name) {
  for (int k = 0; k < int(preset.block.size()); ++k)
    for (const char* side : side_names)
      if (name == preset.block[std::size_t(k)].name + "." + side) return NamedSide{k, side};
  return std::nullopt;
}

}  // namespace gridshell::preset
