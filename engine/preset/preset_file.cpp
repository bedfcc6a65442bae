#include "engine/preset/preset_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>
#include <algorithm>
#include <cctype>
#include <cstring>
#include <set>
#include <tuple>

#include "engine/core/file_io.h"
#include "engine/core/text.h"
#include "engine/preset/consistency.h"
#include "engine/preset/field_table.h"
#include "engine/preset/sweep_grid.h"
#include "engine/preset/toml_reader.h"

namespace gridshell::preset {

namespace {

constexpr std::size_t longest_name = 100;

// the name of a case; empty if there was an error, which is added
std::string case_name(const toml::table& table, const std::set<std::string>& taken,
                      TomlReader& reading) {
  const auto* node = table.get("name");
  const auto location = reading.location_of(node ? node->source() : table.source());
  if (!node) {
    reading.errors().add(location, "[[case]] name: got none, expected a name: name = \"...\"");
    return "";
  }
  const auto name = node->value<std::string>();
  if (const auto wrong = case_name_error(name.value_or("")); !wrong.empty()) {
    reading.errors().add(location, got_text("[[case]] name", toml_text(*node), wrong));
    return "";
  }
  if (taken.contains(*name)) {
    reading.errors().add(location, got_text("[[case]] name", toml_text(*node),
                                            "used twice, expected a unique name"));
    return "";
  }
  return *name;
}

// the base preset and the cases over it
Presets read_presets(const toml::table& root, const std::string& name,
                     const std::vector<Override>& overrides, TomlReader& reading) {
  PresetBuilder base;
  base.preset.name = name;
  reading.apply(root, "case", base);  // all but the cases
  const auto finish = [&](PresetBuilder builder) {
    for (const auto& change : overrides) reading.apply_override(change, builder);
    reading.read_files(builder);
    return builder;
  };
  const auto whole = finish(base);
  Presets presets{whole.preset, {}};
  const auto add_once = [](const std::vector<std::string>& from, std::vector<std::string>& to) {
    for (const std::string& one : from)
      if (std::ranges::find(to, one) == to.end()) to.push_back(one);
  };
  const auto* node = root.get("case");
  if (node && !node->is_array_of_tables()) {
    reading.errors().add(reading.location_of(node->source()),
                         "case: got one table or value, expected tables, each [[case]]");
    return presets;
  }
  std::set<std::string> taken;
  std::vector<PresetBuilder> runs;
  const toml::array none;  // a copy of the list would lose its positions
  for (const auto& item : node ? *node->as_array() : none) {
    const auto& table = *item.as_table();
    PresetBuilder builder = base;
    reading.apply(table, "name", builder);
    builder = finish(std::move(builder));
    const auto own = case_name(table, taken, reading);
    taken.insert(own);
    builder.preset.name = name + "/" + own;
    runs.push_back(builder);
    presets.cases.push_back({own, std::move(builder.preset)});
  }
  if (runs.empty()) runs.push_back(whole);
  for (const PresetBuilder& builder : runs) {
    add_once(builder.read, presets.files);
    add_once(builder.notes, presets.notes);
    add_once(doubtful_values(builder.preset), presets.notes);
  }
  for (const PresetBuilder& builder : runs)
    check_conflicts(builder, reading.source(), reading.errors());
  check_unused_keys(runs, reading.errors());
  check_sweep(runs, reading.errors());
  return presets;
}

std::string comment_of(const Field& field) {
  return field.unit.empty() ? field.meaning : fmt::format("{}: {}", field.unit, field.meaning);
}

// a pipe would end a Markdown cell
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

// whether a key has an effect in a preset
class Used {
 public:
  explicit Used(const Preset& preset) {
    for (const KeyError& idle : unused_keys(preset))
      idle_.insert({idle.table, idle.key, idle.item});
  }
  bool operator()(const Field& field, int item = -1) const {
    return !idle_.contains({field.table, field.key, item});
  }

 private:
  std::set<std::tuple<std::string, std::string, int>> idle_;
};

// one item of a list of tables; steps and load cases are written without the keys at their default
std::string item_text(const std::string& table, const Preset& preset, const Used& used, int item,
                      const char* in) {
  static const Preset defaults = default_items();
  auto text = fmt::format("\n[[{}{}]]\n", in, table);
  for (const auto& field : field_table()) {
    if (field.table != table || !used(field, item)) continue;
    const auto value = value_text(field, preset, item);
    const bool sparse = (table == "step" && field.key != "do") || table == "loads.case";
    if (sparse && value == value_text(field, defaults)) continue;
    text += fmt::format("{} = {}\n", field.key, value);
  }
  return text;
}

// all items of a list of tables; `in` is "", or "case." for the list of a case
std::string list_text(const std::string& table, const Preset& preset, const Used& used,
                      const char* in) {
  std::string text;
  const int items = items_of(preset, table).value_or(0);
  for (int k = 0; k < items; ++k) text += item_text(table, preset, used, k, in);
  return text;
}

}  // namespace

std::string case_name_error(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || std::strchr("._-", c); };
  if (name.empty() || !std::isalnum((unsigned char)name.front()) ||
      !std::ranges::all_of(name, plain))
    return "the name of a folder, expected letters, digits, '.', '_' or '-' after a letter or "
           "digit";
  if (name.size() > longest_name)
    return fmt::format("{} letters, expected at most {}", name.size(), longest_name);
  const auto kind = std::filesystem::path(name).extension().string();
  for (const char* taken : {".csv",   ".dxf", ".gif",  ".glb", ".h5",  ".html", ".journal", ".json",
                            ".jsonl", ".md",  ".mp4",  ".obj", ".pdf", ".ply",  ".png",     ".pvd",
                            ".stl",   ".svg", ".toml", ".txt", ".vtp", ".xdmf", ".webm"})
    if (kind == taken)
      return fmt::format("a name of a file of a run, expected another ending than {}", kind);
  if (name == "frames") return "the folder of a movie's pictures, expected another name";
  if (name == "segments") return "the folder of an unfinished run's path, expected another name";
  return "";
}

Result<Override> parse_override(const std::string& argument) {
  const auto equals = argument.find('=');
  if (equals == std::string::npos || equals == 0)
    return invalid("--set {}: expected table.key=value, for example --set footprint.radius_mm=126",
                   argument);
  const auto trimmed = [](const std::string& text) {
    const auto first = text.find_first_not_of(' ');
    return first == std::string::npos ? ""
                                      : text.substr(first, text.find_last_not_of(' ') + 1 - first);
  };
  return Override{"--set", trimmed(argument.substr(0, equals)), argument.substr(equals + 1)};
}

Result<Presets> read_preset_text(const std::string& text, const std::string& source,
                                 const std::string& name, const std::vector<Override>& overrides,
                                 const std::map<std::string, std::string>& files) {
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    const auto& at = error.source().begin;
    return invalid("{}:{}:{}: not TOML: {}", source, at.line, at.column, error.description());
  }
  TomlReader reading(source, {std::filesystem::path(source).parent_path(), &files});
  auto presets = read_presets(root, name, overrides, reading);
  if (!reading.errors().empty()) return invalid(reading.errors().report());
  return presets;
}

Result<Presets> read_preset_file(const std::filesystem::path& file,
                                 const std::vector<Override>& overrides) {
  auto text = read_file(file, largest_text);
  if (!text) return invalid(text.error().message);
  return read_preset_text(*text, file.string(), file.stem().string(), overrides);
}

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
  each_list([&](const char* name, auto) { text += list_text(name, preset, used, ""); });
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
      if (is_list_name(field.table) || !in_case(field)) continue;
      const auto value = value_text(field, one.preset);
      // what a reader of the text knows without this line: the value of the base, or the default
      if (value == value_text(field, in_base(field) ? presets.base : defaults)) continue;
      text += fmt::format("{}{}{} = {}\n", field.table, field.table.empty() ? "" : ".", field.key,
                          value);
    }
    std::string items;
    each_list([&](const char* name, auto) {
      const auto own = list_text(name, one.preset, in_case, "case.");
      if (own == list_text(name, presets.base, in_base, "case.")) return;
      // tables are written after all keys
      if (own.empty())
        text += fmt::format("{} = []\n", name);
      else
        items += own;
    });
    text += items;
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
