#include "engine/preset/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "engine/preset/field_table.h"
#include "engine/preset/lists.h"
#include "engine/preset/use.h"

namespace gridshell::preset {
namespace {

std::string comment_of(const Field& field) {
  return field.unit.empty() ? field.meaning : fmt::format("{}: {}", field.unit, field.meaning);
}

// a pipe would end a Markdown cell
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

// names of the keys that count for something, or do not
class Used {
 public:
  explicit Used(const Preset& preset) {
    for (const IdleKey& idle : idle_keys(preset)) idle_.insert({idle.table, idle.key, idle.item});
  }
  bool operator()(const Field& field, int item = -1) const {
    return !idle_.contains({field.table, field.key, item});
  }

 private:
  std::set<std::tuple<std::string, std::string, int>> idle_;
};

// one item of a list of tables; where most keys are not wanted, those that say their default are
// left out
std::string item_text(const std::string& table, const Preset& preset, const Used& used, int item) {
  static const Preset defaults = default_items();
  const Preset one = up_to(preset, item);
  auto text = fmt::format("\n[[{}]]\n", table);
  for (const auto& field : field_table()) {
    if (field.table != table || !used(field, item)) continue;
    const auto value = value_text(field, one);
    if (table == "step" && field.key != "do" && value == value_text(field, defaults)) continue;
    text += fmt::format("{} = {}\n", field.key, value);
  }
  return text;
}

bool is_list(const std::string& name) {
  return std::any_of(tables().begin(), tables().end(),
                     [&](const Table& table) { return table.list && table.name == name; });
}

}  // namespace

std::string to_toml(const Preset& preset) {
  const Used used(preset);
  std::string text;
  for (const auto& table : tables()) {
    if (table.list) continue;
    std::string keys;
    for (const auto& field : field_table())
      if (field.table == table.name && used(field))
        keys +=
            fmt::format("{} = {}  # {}\n", field.key, value_text(field, preset), comment_of(field));
    if (!table.name.empty() && !keys.empty())
      text += fmt::format("\n[{}]  # {}\n", table.name, table.meaning);
    text += keys;
  }
  each_list([&](const char* name, auto member) {
    for (int k = 0; k < int((preset.*member).size()); ++k) text += item_text(name, preset, used, k);
  });
  return text;
}

std::string to_toml(const Presets& presets) {
  auto text = to_toml(presets.base);
  const Used in_base(presets.base);
  const Preset defaults;
  for (const auto& one : presets.cases) {
    const Used in_case(one.preset);
    text += fmt::format("\n[[case]]\nname = \"{}\"\n", one.name);
    for (const auto& field : field_table()) {
      if (is_list(field.table) || !in_case(field)) continue;
      const auto value = value_text(field, one.preset);
      // what stands above, or where nothing does the default
      if (value == value_text(field, in_base(field) ? presets.base : defaults)) continue;
      text += fmt::format("{}{}{} = {}\n", field.table, field.table.empty() ? "" : ".", field.key,
                          value);
    }
  }
  return text;
}

std::vector<KeyText> key_texts() {
  const Preset defaults = default_items();
  std::vector<KeyText> keys;
  for (const auto& table : tables())
    for (const auto& field : field_table())
      if (field.table == table.name)
        keys.push_back({field.table, field.key, field.unit, value_text(field, defaults),
                        allowed(field), field.meaning});
  return keys;
}

std::string reference_markdown() {
  const auto keys = key_texts();
  std::string text;
  for (const auto& table : tables()) {
    text += table.name.empty() ? "At the top of the file: "
            : table.list       ? fmt::format("`[[{}]]` ", table.name)
                               : fmt::format("`[{}]` ", table.name);
    text += table.meaning + "\n\n| key | unit | default | allowed | meaning |\n";
    text += "| --- | --- | --- | --- | --- |\n";
    for (const KeyText& key : keys)
      if (key.table == table.name)
        text += fmt::format("| `{}` | {} | `{}` | {} | {} |\n", key.key, key.unit, key.value,
                            cell(key.allowed), cell(key.meaning));
    text += "\n";
  }
  return text;
}

}  // namespace gridshell::preset
