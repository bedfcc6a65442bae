#include "engine/preset/preset_builder.h"

#include <fmt/format.h>
#include <algorithm>
#include <tuple>

#include "engine/core/text.h"
#include "engine/preset/consistency.h"
#include "engine/preset/field_table.h"
#include "engine/preset/materials.h"

namespace gridshell::preset {

std::string SourceLocation::text() const {
  return line == 0 ? source : fmt::format("{}:{}:{}", source, line, column);
}

std::string LocatedErrors::report() const {
  auto sorted = errors_;
  std::ranges::stable_sort(sorted, [](const LocatedError& a, const LocatedError& b) {
    const auto rank = [](const SourceLocation& p) {
      return std::tuple(p.line == 0, p.line, p.column);
    };
    return rank(a.location) < rank(b.location);
  });
  std::string text;
  std::set<std::string> seen;
  for (const auto& one : sorted) {
    const auto line = one.location.text() + ": " + one.text;
    if (seen.insert(line).second) text += (text.empty() ? "" : "\n") + line;
  }
  return text;
}

void PresetBuilder::forget_items(const std::string& table) {
  each_list([&](const char* name, auto member) {
    if (table == name) (preset.*member).clear();
  });
  const auto of_table = [&](const std::string& key) {
    return key.starts_with("[[" + table + "]]");
  };
  std::erase_if(set_at, [&](const auto& one) { return of_table(one.first); });
  std::erase_if(faulty, of_table);
  std::erase_if(files, [&](const auto& one) { return of_table(one.first); });
}

void PresetBuilder::take_material(const std::string& table) {
  const bool second = table == "rod_v";
  const auto named = set_at.find(key_label(table, "material"));
  if (named == set_at.end()) return;
  const ValueLayer layer = named->second.layer;
  preset::take_material(second ? preset.rod_v : preset.rod, second ? given.rod_v : given.rod,
                        [&](const char* key) {
                          const auto set = set_at.find(key_label(table, key));
                          return set != set_at.end() && set->second.layer >= layer;
                        });
}

namespace {

// whether a later layer set one of the deciding keys: then the key had an effect in its own layer
bool overridden_above(const PresetBuilder& builder, const std::vector<std::string>& deciders,
                      ValueLayer layer) {
  return std::ranges::any_of(deciders, [&](const std::string& decider) {
    const auto set = builder.set_at.find(decider);
    return set != builder.set_at.end() && set->second.layer > layer;
  });
}

/// Text of an error: "[rod] diameter_mm: got 20.0 (neighbouring rods would touch), expected ...",
/// or for a key without effect "[net] waist = 0.4 has no effect, leave it out: ..."
std::string error_text(const Preset& preset, const KeyError& fault, bool no_effect = false) {
  // a network or a table may have thousands of points
  constexpr std::size_t longest = 60;
  auto value = value_text(*find_field(fault.table, fault.key), preset, fault.item);
  // the contents of a file are not repeated: its own error names the position in it
  if (value.starts_with('{'))
    return fmt::format("{}: {}{}", fault.label(), no_effect ? "has no effect, leave it out: " : "",
                       fault.what);
  if (value.size() > longest) value.replace(longest - 3, std::string::npos, "...");
  if (no_effect)
    return fmt::format("{} = {} has no effect, leave it out: {}", fault.label(), value, fault.what);
  return got_text(fault.label(), value, fault.what);
}

// a key whose value was refused has its default, so a contradiction with it is not the user's
bool any_refused(const PresetBuilder& builder, const std::vector<std::string>& keys) {
  return std::ranges::any_of(keys, [&](const auto& key) { return builder.faulty.contains(key); });
}

bool is_default(const PresetBuilder& builder, const KeyError& fault) {
  static const Preset defaults = default_items();
  const Field& field = *find_field(fault.table, fault.key);
  return value_text(field, builder.preset, fault.item) == value_text(field, defaults);
}

}  // namespace

void check_conflicts(const PresetBuilder& builder, const std::string& source,
                     LocatedErrors& errors) {
  for (const KeyError& fault : conflicts(builder.preset)) {
    auto keys = fault.others;
    keys.insert(keys.begin(), fault.label());
    if (any_refused(builder, keys)) continue;
    if (fault.item >= 0) keys.push_back(key_label(fault.table, "", fault.item));
    const auto set = std::ranges::find_if(
        keys, [&](const std::string& key) { return builder.set_at.contains(key); });
    errors.add(set == keys.end() ? SourceLocation{source} : builder.set_at.at(*set),
               error_text(builder.preset, fault));
  }
}

void check_unused_keys(const std::vector<PresetBuilder>& runs, LocatedErrors& errors) {
  std::map<std::string, std::size_t> unused_in;
  std::vector<std::vector<KeyError>> unused;
  for (const PresetBuilder& builder : runs)
    for (const KeyError& one : unused.emplace_back(unused_keys(builder.preset)))
      ++unused_in[one.label()];
  for (std::size_t run = 0; run < runs.size(); ++run)
    for (const KeyError& one : unused[run]) {
      const PresetBuilder& builder = runs[run];
      const auto name = one.label();
      const auto set = builder.set_at.find(name);
      if (set == builder.set_at.end() || builder.faulty.contains(name)) continue;
      const ValueLayer layer = set->second.layer;
      // a value outside of cases may be used by another case
      if (layer != ValueLayer::one_case && unused_in[name] < runs.size()) continue;
      // a key that is set to its default is accepted everywhere
      if (overridden_above(builder, one.others, layer) || any_refused(builder, one.others) ||
          is_default(builder, one))
        continue;
      errors.add(set->second, error_text(builder.preset, one, true));
    }
}

}  // namespace gridshell::preset
