#include "engine/preset/preset_builder.h"

#include <fmt/format.h>
#include <algorithm>
#include <set>
#include <tuple>

#include "engine/preset/consistency.h"
#include "engine/preset/field_table.h"
#include "engine/preset/preset_access.h"

namespace gridshell::preset {

std::string SourceLocation::text() const {
  return line == 0 ? source : fmt::format("{}:{}:{}", source, line, column);
}

std::string LocatedFaults::report() const {
  auto sorted = faults_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const LocatedFault& a, const LocatedFault& b) {
    const auto rank = [](const SourceLocation& p) {
      return std::tuple(p.line == 0, p.line, p.column);
    };
    return rank(a.place) < rank(b.place);
  });
  std::string text;
  std::set<std::string> seen;
  for (const auto& one : sorted) {
    const auto line = one.place.text() + ": " + one.text;
    if (seen.insert(line).second) text += (text.empty() ? "" : "\n") + line;
  }
  return text;
}

namespace {

// whether a decider was laid over the layer in which a key stands: the key was of use below
bool overridden_above(const PresetBuilder& draft, const std::vector<std::string>& deciders,
                      ValueLayer layer) {
  return std::ranges::any_of(deciders, [&](const std::string& decider) {
    const auto set = draft.set_at.find(decider);
    return set != draft.set_at.end() && set->second.layer > layer;
  });
}

// a key that says its default asks for nothing
void refuse_unused(const PresetBuilder& draft, const UnusedKey& idle, LocatedFaults& faults) {
  const auto name = key_label(idle.table, idle.key, idle.item);
  const auto& field = *find_field(idle.table, idle.key);
  const Preset defaults = default_items();
  const auto value = value_text(field, lists_up_to(draft.preset, idle.item));
  if (value == value_text(field, defaults)) return;
  const auto refused = [&](const std::string& key) { return draft.faulty.contains(key); };
  if (std::ranges::any_of(idle.deciders, refused)) return;
  faults.add(
      draft.set_at.at(name),
      fmt::format("{} = {}: counts for nothing here, must be left out: {}", name, value, idle.why));
}

}  // namespace

std::string key_label(const std::string& table, const std::string& key, int item) {
  if (item >= 0) return fmt::format("[[{}]] {} {}", table, item + 1, key);
  return table.empty() ? key : fmt::format("[{}] {}", table, key);
}

void check_conflicts(const PresetBuilder& draft, const std::string& source, LocatedFaults& faults) {
  for (const auto& conflict : conflicts(draft.preset)) {
    const auto name = key_label(conflict.table, conflict.key, conflict.item);
    // a refused value left its default behind, which conflicts with nothing the user wrote
    const auto refused = [&](const std::string& key) { return draft.faulty.contains(key); };
    if (refused(name) || std::ranges::any_of(conflict.others, refused)) continue;
    const auto* field = find_field(conflict.table, conflict.key);
    auto keys = conflict.others;
    keys.insert(keys.begin(), name);
    if (conflict.item >= 0) keys.push_back(key_label(conflict.table, "", conflict.item));
    const auto set = std::ranges::find_if(
        keys, [&](const std::string& key) { return draft.set_at.contains(key); });
    faults.add(
        set == keys.end() ? SourceLocation{source} : draft.set_at.at(*set),
        fmt::format("{} = {}: {}", name,
                    value_text(*field, lists_up_to(draft.preset, conflict.item)), conflict.what));
  }
}

void check_unused_keys(const std::vector<PresetBuilder>& runs, LocatedFaults& faults) {
  std::map<std::string, std::size_t> idle_in;
  for (const PresetBuilder& draft : runs)
    for (const UnusedKey& idle : unused_keys(draft.preset))
      ++idle_in[key_label(idle.table, idle.key, idle.item)];
  for (const PresetBuilder& draft : runs)
    for (const UnusedKey& idle : unused_keys(draft.preset)) {
      const auto name = key_label(idle.table, idle.key, idle.item);
      const auto set = draft.set_at.find(name);
      if (set == draft.set_at.end() || draft.faulty.contains(name)) continue;
      // what the base says may be for another case
      if (set->second.layer != ValueLayer::one_case && idle_in[name] < runs.size()) continue;
      if (!overridden_above(draft, idle.deciders, set->second.layer))
        refuse_unused(draft, idle, faults);
    }
}

}  // namespace gridshell::preset
