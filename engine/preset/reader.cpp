#include "engine/preset/reader.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cctype>
#include <cstring>
#include <set>

#include "engine/core/atomic_file.h"
#include "engine/preset/assign.h"
#include "engine/preset/reading.h"
#include "engine/preset/sweep_grid.h"

namespace gridshell::preset {
namespace {

constexpr std::size_t longest_name = 100;

// the name of a case, or empty with a fault
std::string case_name(const toml::table& table, const std::set<std::string>& taken,
                      Reading& reading) {
  const auto* node = table.get("name");
  const auto place = reading.place_of(node ? node->source() : table.source());
  if (!node) {
    reading.faults().add(place, "[[case]]: has no name, must have one: name = \"...\"");
    return "";
  }
  const auto name = node->value<std::string>();
  if (const auto wrong = case_name_fault(name.value_or("")); !wrong.empty()) {
    reading.faults().add(place, fmt::format("[[case]] name = {}: {}", shown(*node), wrong));
    return "";
  }
  if (taken.contains(*name)) {
    reading.faults().add(
        place, fmt::format("[[case]] name = {}: used twice, must be unique", shown(*node)));
    return "";
  }
  return *name;
}

// the base preset and the cases over it
Presets read_presets(const toml::table& root, const std::string& name,
                     const std::vector<Override>& overrides, Reading& reading) {
  Draft base;
  base.preset.name = name;
  reading.lay(root, "case", base);  // and with it the lists of tables
  const auto finish = [&](Draft draft) {
    for (const auto& change : overrides) reading.lay_override(change, draft);
    return draft;
  };
  const auto whole = finish(base);
  Presets presets{whole.preset, {}};
  const auto* node = root.get("case");
  if (node && !node->is_array_of_tables()) {
    reading.faults().add(reading.place_of(node->source()), "case: must be tables, each [[case]]");
    return presets;
  }
  std::set<std::string> taken;
  std::vector<Draft> runs;
  const toml::array none;  // a copy of the list would not know its places
  for (const auto& item : node ? *node->as_array() : none) {
    const auto& table = *item.as_table();
    Draft draft = base;
    reading.lay(table, "name", draft);
    draft = finish(std::move(draft));
    const auto own = case_name(table, taken, reading);
    taken.insert(own);
    draft.preset.name = name + "/" + own;
    runs.push_back(draft);
    presets.cases.push_back({own, std::move(draft.preset)});
  }
  if (runs.empty()) runs.push_back(whole);
  for (const Draft& draft : runs) check_conflicts(draft, reading.source(), reading.faults());
  check_use(runs, reading.faults());
  check_sweep(runs, reading.faults());
  return presets;
}

}  // namespace

std::string case_name_fault(const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || std::strchr("._-", c); };
  if (name.empty() || !std::isalnum((unsigned char)name.front()) ||
      !std::all_of(name.begin(), name.end(), plain))
    return "names a folder, must be letters, digits, '.', '_' or '-' and begin with a letter or "
           "digit";
  if (name.size() > longest_name)
    return fmt::format("is {} letters long, must be at most {}", name.size(), longest_name);
  const auto kind = std::filesystem::path(name).extension().string();
  for (const char* taken : {".csv", ".gif", ".h5", ".journal", ".json", ".mp4", ".pdf", ".png",
                            ".svg", ".toml", ".webm"})
    if (kind == taken) return fmt::format("must not end in {}, as the files of a run do", kind);
  if (name == "frames") return "is the folder of a movie's pictures, must be another name";
  return "";
}

Result<Override> parse_override(const std::string& argument) {
  const auto equals = argument.find('=');
  if (equals == std::string::npos || equals == 0)
    return fail(Fault::bad_input, fmt::format("--set {}: must be table.key=value, for example "
                                              "--set footprint.radius_mm=126",
                                              argument));
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
    return fail(Fault::bad_input, fmt::format("{}:{}:{}: not TOML: {}", source, at.line, at.column,
                                              error.description()));
  }
  Reading reading(source, {std::filesystem::path(source).parent_path(), &files});
  auto presets = read_presets(root, name, overrides, reading);
  if (!reading.faults().empty()) return fail(Fault::bad_input, reading.faults().report());
  return presets;
}

Result<Presets> read_preset_file(const std::filesystem::path& file,
                                 const std::vector<Override>& overrides) {
  auto text = read_whole(file, largest_text);
  if (!text) return fail(Fault::bad_input, text.error().message);
  return read_preset_text(*text, file.string(), file.stem().string(), overrides);
}

}  // namespace gridshell::preset
