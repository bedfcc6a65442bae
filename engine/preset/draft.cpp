#include "engine/preset/draft.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/preset/consistency.h"
#include "engine/preset/field_table.h"
#include "engine/preset/lists.h"
#include "engine/preset/use.h"

namespace gridshell::preset {
namespace {

// whether a decider was laid over the layer in which a key stands: the key was of use below
bool set_aside_above(const Draft& draft, const std::vector<std::string>& deciders, Layer layer) {
  return std::ranges::any_of(deciders, [&](const std::string& decider) {
    const auto set = draft.set_at.find(decider);
    return set != draft.set_at.end() && set->second.layer > layer;
  });
}

// a key that says its default asks for nothing
void refuse_idle(const Draft& draft, const IdleKey& idle, PlacedFaults& faults) {
  const auto name = bracketed(idle.table, idle.key, idle.item);
  const auto& field = *find_field(idle.table, idle.key);
  const Preset defaults = default_items();
  const auto value = value_text(field, up_to(draft.preset, idle.item));
  if (value == value_text(field, defaults)) return;
  const auto refused = [&](const std::string& key) { return draft.faulty.contains(key); };
  if (std::ranges::any_of(idle.deciders, refused)) return;
  faults.add(
      draft.set_at.at(name),
      fmt::format("{} = {}: counts for nothing here, must be left out: {}", name, value, idle.why));
}

}  // namespace

std::string bracketed(const std::string& table, const std::string& key, int item) {
  if (item >= 0) return fmt::format("[[{}]] {} {}", table, item + 1, key);
  return table.empty() ? key : fmt::format("[{}] {}", table, key);
}

void check_conflicts(const Draft& draft, const std::string& source, PlacedFaults& faults) {
  for (const auto& conflict : conflicts(draft.preset)) {
    const auto name = bracketed(conflict.table, conflict.key, conflict.item);
    // a refused value left its default behind, which conflicts with nothing the user wrote
    const auto refused = [&](const std::string& key) { return draft.faulty.contains(key); };
    if (refused(name) || std::ranges::any_of(conflict.others, refused)) continue;
    const auto* field = find_field(conflict.table, conflict.key);
    auto keys = conflict.others;
    keys.insert(keys.begin(), name);
    if (conflict.item >= 0) keys.push_back(bracketed(conflict.table, "", conflict.item));
    const auto set = std::ranges::find_if(
        keys, [&](const std::string& key) { return draft.set_at.contains(key); });
    faults.add(set == keys.end() ? Place{source} : draft.set_at.at(*set),
               fmt::format("{} = {}: {}", name,
                           value_text(*field, up_to(draft.preset, conflict.item)), conflict.what));
  }
}

void check_use(const std::vector<Draft>& runs, PlacedFaults& faults) {
  std::map<std::string, std::size_t> idle_in;
  for (const Draft& draft : runs)
    for (const IdleKey& idle : idle_keys(draft.preset))
      ++idle_in[bracketed(idle.table, idle.key, idle.item)];
  for (const Draft& draft : runs)
    for (const IdleKey& idle : idle_keys(draft.preset)) {
      const auto name = bracketed(idle.table, idle.key, idle.item);
      const auto set = draft.set_at.find(name);
      if (set == draft.set_at.end() || draft.faulty.contains(name)) continue;
      // what the base says may be for another case
      if (set->second.layer != Layer::one_case && idle_in[name] < runs.size()) continue;
      if (!set_aside_above(draft, idle.deciders, set->second.layer))
        refuse_idle(draft, idle, faults);
    }
}

}  // namespace gridshell::preset
