#include "engine/preset/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "engine/preset/assign.h"
#include "engine/preset/field_table.h"
#include "engine/preset/lists.h"
#include "engine/preset/suggest.h"
#include "engine/preset/sweep_axes.h"

namespace gridshell::preset {
namespace {

std::vector<std::string> keys_of(const std::string& table) {
  std::vector<std::string> keys;
  for (const auto& field : field_table())
    if (field.table == table) keys.push_back(field.key);
  return keys;
}

std::vector<std::string> table_names() {
  std::vector<std::string> names{"case"};
  for (const auto& table : tables())
    if (!table.name.empty()) names.push_back(table.name);
  return names;
}

bool is_list_name(const std::string& name) {
  return std::ranges::any_of(tables(),
                             [&](const Table& table) { return table.list && table.name == name; });
}

bool is_table_name(const std::string& name) {
  const auto names = table_names();
  return name != "case" && !is_list_name(name) &&
         std::find(names.begin(), names.end(), name) != names.end();
}

toml::table override_value(const std::string& value) {
  try {
    auto parsed = toml::parse("x = " + value);
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
  }
  return toml::table{{"x", value}};
}

// what a mistyped key may have been: a near one of its table, the same one of another table, or
// else the list of what there is
std::string hint(const std::string& table, const std::string& name) {
  const auto here = keys_of(table);
  if (const auto near = did_you_mean(name, here); !near.empty()) return near;
  for (const auto& field : field_table())
    if (field.key == name)
      return fmt::format("; did you mean '{}{}{}'?", field.table, field.table.empty() ? "" : ".",
                         name);
  return fmt::format(", must be one of {}", fmt::join(here, ", "));
}

}  // namespace

Place Reading::place_of(const toml::source_region& region) const {
  // values of an override have no place in the file
  if (!override_.empty()) return {override_, 0, 0, Layer::command_line};
  return {source_, unsigned(region.begin.line), unsigned(region.begin.column), layer_};
}

void Reading::lay(const toml::table& root, const std::string& apart, Draft& draft) {
  layer_ = apart == "case" ? Layer::file : Layer::one_case;
  for (const auto& [key, value] : root) {
    const std::string name(key.str());
    if (name == apart) continue;
    if (is_list_name(name))
      lay_items(key, value, apart == "case", draft);
    else if (!is_table_name(name) && !value.is_table())
      assign_key("", key, value, draft);
    else
      lay_table(key, value, draft);
  }
}

void Reading::lay_override(const Override& change, Draft& draft) {
  override_ = change.source;
  const auto dot = change.key.find('.');
  const bool top = dot == std::string::npos;
  const auto table = top ? "" : change.key.substr(0, dot);
  const auto name = top ? change.key : change.key.substr(dot + 1);
  const auto value = override_value(change.value);
  if (!top && !is_table_name(table))
    faults_.add({override_},
                fmt::format("[{}] {} = {}: unknown table{}", table, name, shown(*value.get("x")),
                            did_you_mean(table, table_names())));
  else
    assign_key(table, toml::key(name), *value.get("x"), draft);
  override_.clear();
}

// the items of a list of tables, each with defaults of its own
void Reading::lay_items(const toml::key& key, const toml::node& value, bool in_file, Draft& draft) {
  const std::string name(key.str());
  if (!in_file || !value.is_array_of_tables()) {
    faults_.add(place_of(key.source()),
                in_file ? fmt::format("{}: must be tables, each [[{}]]", name, name)
                        : fmt::format("{}: stands outside of cases, as [[{}]]", name, name));
    return;
  }
  int item = 0;
  for (const auto& table : *value.as_array()) {
    add_item(draft.preset, name);
    draft.set_at[bracketed(name, "", item)] = place_of(table.source());
    for (const auto& [inner, one] : *table.as_table()) assign_key(name, inner, one, draft, item);
    ++item;
  }
}

void Reading::lay_table(const toml::key& key, const toml::node& value, Draft& draft) {
  const std::string name(key.str());
  const auto place = place_of(key.source());
  if (!is_table_name(name)) {
    faults_.add(place,
                fmt::format("[{}]: unknown table{}", name, did_you_mean(name, table_names())));
  } else if (const auto* table = value.as_table()) {
    for (const auto& [inner, item] : *table) assign_key(name, inner, item, draft);
  } else {
    faults_.add(place, fmt::format("{} = {}: is a table, must hold keys: {}", name, shown(value),
                                   fmt::join(keys_of(name), ", ")));
  }
}

void Reading::lay_axes(const AxisList& list, const toml::table& over, Draft& draft) {
  std::vector<AxisFault> wrong;
  list.in(draft.preset) = read_axes(over, wrong);
  for (auto& fault : wrong) faults_.add(place_of(fault.place), std::move(fault.text));
  if (!wrong.empty()) draft.faulty.insert("[sweep] over");
}

void Reading::assign_key(const std::string& table, const toml::key& key, const toml::node& value,
                         Draft& draft, int item) {
  const std::string name(key.str());
  const auto* field = find_field(table, name);
  const auto full = bracketed(table, name, item);
  if (!field) {
    faults_.add(place_of(key.source()),
                fmt::format("{} = {}: unknown key{}", full, shown(value), hint(table, name)));
    return;
  }
  const auto place = place_of(value.source());
  if (table == "sweep" && place.layer == Layer::one_case) {
    faults_.add(place, fmt::format("{} = {}: stands outside of cases: a sweep runs all of them",
                                   full, shown(value)));
    return;
  }
  if (const auto* axes = std::get_if<AxisList>(&field->kind); axes && value.is_table()) {
    draft.set_at[full] = place_of(key.source());
    lay_axes(*axes, *value.as_table(), draft);
    return;
  }
  const auto wrong = assign(*field, value, draft.preset, override_.empty() ? beside_ : Beside{});
  draft.set_at[full] = place;
  if (wrong.empty()) {
    draft.faulty.erase(full);
  } else {
    draft.faulty.insert(full);
    faults_.add(place, fmt::format("{} = {}: {}", full, shown(value), wrong));
  }
}

}  // namespace gridshell::preset
