#include "engine/preset/writer.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/preset/field_table.h"

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

// the last item of a list of tables
std::string item_text(const std::string& table, const Preset& preset) {
  auto text = fmt::format("\n[[{}]]\n", table);
  for (const auto& field : field_table())
    if (field.table == table)
      text += fmt::format("{} = {}\n", field.key, value_text(field, preset));
  return text;
}

bool is_list(const std::string& name) {
  return std::any_of(tables().begin(), tables().end(),
                     [&](const Table& table) { return table.list && table.name == name; });
}

}  // namespace

std::string to_toml(const Preset& preset) {
  std::string text;
  for (const auto& table : tables()) {
    if (table.list) continue;
    if (!table.name.empty()) text += fmt::format("\n[{}]  # {}\n", table.name, table.meaning);
    for (const auto& field : field_table())
      if (field.table == table.name)
        text +=
            fmt::format("{} = {}  # {}\n", field.key, value_text(field, preset), comment_of(field));
  }
  for (const Block& block : preset.block) {
    Preset one;
    one.block = {block};
    text += item_text("block", one);
  }
  for (const Join& join : preset.join) {
    Preset one;
    one.join = {join};
    text += item_text("join", one);
  }
  return text;
}

std::string to_toml(const Presets& presets) {
  auto text = to_toml(presets.base);
  for (const auto& one : presets.cases) {
    text += fmt::format("\n[[case]]\nname = \"{}\"\n", one.name);
    for (const auto& field : field_table()) {
      if (is_list(field.table)) continue;
      const auto value = value_text(field, one.preset);
      if (value == value_text(field, presets.base)) continue;
      text += fmt::format("{}{}{} = {}\n", field.table, field.table.empty() ? "" : ".", field.key,
                          value);
    }
  }
  return text;
}

std::string reference_markdown() {
  Preset defaults;
  // what an item is before a key of it is read
  defaults.block.emplace_back();
  defaults.join.emplace_back();
  std::string text;
  for (const auto& table : tables()) {
    text += table.name.empty() ? "At the top of the file: "
            : table.list       ? fmt::format("`[[{}]]` ", table.name)
                               : fmt::format("`[{}]` ", table.name);
    text += table.meaning + "\n\n| key | unit | default | allowed | meaning |\n";
    text += "| --- | --- | --- | --- | --- |\n";
    for (const auto& field : field_table())
      if (field.table == table.name)
        text += fmt::format("| `{}` | {} | `{}` | {} | {} |\n", field.key, field.unit,
                            value_text(field, defaults), cell(allowed(field)), cell(field.meaning));
    text += "\n";
  }
  return text;
}

}  // namespace gridshell::preset
