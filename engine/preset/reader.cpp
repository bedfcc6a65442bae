#include "engine/preset/reader.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "engine/core/atomic_file.h"
#include "engine/preset/assign.h"
#include "engine/preset/consistency.h"
#include "engine/preset/field_table.h"
#include "engine/preset/suggest.h"
#include "engine/preset/use.h"

namespace gridshell::preset {
namespace {

// what is laid over what
enum class Layer { file, one_case, command_line };

// where a value came from: a place in a file, or an option of the command line
struct Place {
  std::string source;
  unsigned line = 0, column = 0;
  Layer layer = Layer::file;

  std::string text() const {
    return line == 0 ? source : fmt::format("{}:{}:{}", source, line, column);
  }
};

struct PlacedFault {
  Place place;
  std::string text;
};

// a preset on its way, and where each of its keys was set
struct Draft {
  Preset preset;
  std::map<std::string, Place> set_at;  // by bracketed name
  std::set<std::string> faulty;         // keys whose value was refused
};

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

// how a fault calls a key; `item` counts the tables of a list from 0
std::string bracketed(const std::string& table, const std::string& key, int item = -1) {
  if (item >= 0) return fmt::format("[[{}]] {} {}", table, item + 1, key);
  return table.empty() ? key : fmt::format("[{}] {}", table, key);
}

// Lays TOML over presets and gathers what is wrong on the way.
class Reading {
 public:
  Reading(std::string source, std::filesystem::path folder)
      : source_(std::move(source)), folder_(std::move(folder)) {}

  Place place_of(const toml::source_region& region) const {
    // values of an override have no place in the file
    if (!override_.empty()) return {override_, 0, 0, Layer::command_line};
    return {source_, unsigned(region.begin.line), unsigned(region.begin.column), layer_};
  }

  void fault(const Place& place, std::string text) { faults_.push_back({place, std::move(text)}); }

  // the keys of a file, or of one of its cases, over a draft; `apart` is read by someone else
  void lay(const toml::table& root, const std::string& apart, Draft& draft) {
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

  // one value of the command line over a draft
  void lay_override(const Override& change, Draft& draft) {
    override_ = change.source;
    const auto dot = change.key.find('.');
    const bool top = dot == std::string::npos;
    const auto table = top ? "" : change.key.substr(0, dot);
    const auto name = top ? change.key : change.key.substr(dot + 1);
    const auto value = override_value(change.value);
    if (!top && !is_table_name(table))
      fault({override_}, fmt::format("[{}] {} = {}: unknown table{}", table, name,
                                     shown(*value.get("x")), did_you_mean(table, table_names())));
    else
      assign_key(table, toml::key(name), *value.get("x"), draft);
    override_.clear();
  }

  void check(const Draft& draft) {
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
      fault(set == keys.end() ? Place{source_} : draft.set_at.at(*set),
            fmt::format("{} = {}: {}", name, value_text(*field, up_to(draft.preset, conflict.item)),
                        conflict.what));
    }
  }

  // keys that count for nothing in any of the runs of a file, because of what others are set to
  void check_use(const std::vector<Draft>& runs) {
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
        if (!set_aside_above(draft, idle.deciders, set->second.layer)) refuse_idle(draft, idle);
      }
  }

  // all faults, in the order of the file and each once; those of the command line come last
  std::string report() {
    std::stable_sort(faults_.begin(), faults_.end(),
                     [](const PlacedFault& a, const PlacedFault& b) {
                       const auto rank = [](const Place& p) {
                         return std::tuple(p.line == 0, p.line, p.column);
                       };
                       return rank(a.place) < rank(b.place);
                     });
    std::string text;
    std::set<std::string> seen;
    for (const auto& one : faults_) {
      const auto line = one.place.text() + ": " + one.text;
      if (seen.insert(line).second) text += (text.empty() ? "" : "\n") + line;
    }
    return text;
  }

  bool clean() const { return faults_.empty(); }

 private:
  static toml::table override_value(const std::string& value) {
    try {
      auto parsed = toml::parse("x = " + value);
      if (parsed.size() == 1) return parsed;
    } catch (const toml::parse_error&) {
    }
    return toml::table{{"x", value}};
  }

  // the items of a list of tables, each with defaults of its own
  void lay_items(const toml::key& key, const toml::node& value, bool in_file, Draft& draft) {
    const std::string name(key.str());
    if (!in_file || !value.is_array_of_tables()) {
      fault(place_of(key.source()),
            in_file ? fmt::format("{}: must be tables, each [[{}]]", name, name)
                    : fmt::format("{}: stands outside of cases, as [[{}]]", name, name));
      return;
    }
    int item = 0;
    for (const auto& table : *value.as_array()) {
      if (name == "block")
        draft.preset.block.emplace_back();
      else
        draft.preset.join.emplace_back();
      draft.set_at[bracketed(name, "", item)] = place_of(table.source());
      for (const auto& [inner, one] : *table.as_table()) assign_key(name, inner, one, draft, item);
      ++item;
    }
  }

  // a preset whose lists of tables end with an item
  static Preset up_to(Preset preset, int item) {
    if (item < 0) return preset;
    preset.block.resize(std::min(preset.block.size(), std::size_t(item) + 1));
    preset.join.resize(std::min(preset.join.size(), std::size_t(item) + 1));
    return preset;
  }

  void lay_table(const toml::key& key, const toml::node& value, Draft& draft) {
    const std::string name(key.str());
    const auto place = place_of(key.source());
    if (!is_table_name(name)) {
      fault(place, fmt::format("[{}]: unknown table{}", name, did_you_mean(name, table_names())));
    } else if (const auto* table = value.as_table()) {
      for (const auto& [inner, item] : *table) assign_key(name, inner, item, draft);
    } else {
      fault(place, fmt::format("{} = {}: is a table, must hold keys: {}", name, shown(value),
                               fmt::join(keys_of(name), ", ")));
    }
  }

  void assign_key(const std::string& table, const toml::key& key, const toml::node& value,
                  Draft& draft, int item = -1) {
    const std::string name(key.str());
    const auto* field = find_field(table, name);
    const auto full = bracketed(table, name, item);
    if (!field) {
      fault(place_of(key.source()),
            fmt::format("{} = {}: unknown key{}", full, shown(value), hint(table, name)));
      return;
    }
    const auto place = place_of(value.source());
    const auto wrong = assign(*field, value, draft.preset, override_.empty() ? folder_ : "");
    draft.set_at[full] = place;
    if (wrong.empty()) {
      draft.faulty.erase(full);
    } else {
      draft.faulty.insert(full);
      fault(place, fmt::format("{} = {}: {}", full, shown(value), wrong));
    }
  }

  // whether a decider was laid over the layer in which a key stands: the key was of use below
  static bool set_aside_above(const Draft& draft, const std::vector<std::string>& deciders,
                              Layer layer) {
    return std::ranges::any_of(deciders, [&](const std::string& decider) {
      const auto set = draft.set_at.find(decider);
      return set != draft.set_at.end() && set->second.layer > layer;
    });
  }

  // a key that says its default asks for nothing
  void refuse_idle(const Draft& draft, const IdleKey& idle) {
    const auto name = bracketed(idle.table, idle.key, idle.item);
    const auto& field = *find_field(idle.table, idle.key);
    Preset defaults;
    defaults.block.emplace_back();
    defaults.join.emplace_back();
    const auto value = value_text(field, up_to(draft.preset, idle.item));
    if (value == value_text(field, defaults)) return;
    const auto refused = [&](const std::string& key) { return draft.faulty.contains(key); };
    if (std::ranges::any_of(idle.deciders, refused)) return;
    fault(draft.set_at.at(name),
          fmt::format("{} = {}: counts for nothing here, must be left out: {}", name, value,
                      idle.why));
  }

  // what a mistyped key may have been: a near one of its table, the same one of another table, or
  // else the list of what there is
  static std::string hint(const std::string& table, const std::string& name) {
    const auto here = keys_of(table);
    if (const auto near = did_you_mean(name, here); !near.empty()) return near;
    for (const auto& field : field_table())
      if (field.key == name)
        return fmt::format("; did you mean '{}{}{}'?", field.table, field.table.empty() ? "" : ".",
                           name);
    return fmt::format(", must be one of {}", fmt::join(here, ", "));
  }

  std::string source_;
  std::filesystem::path folder_;  // of the file
  std::string override_;          // while an override is laid: its option
  Layer layer_ = Layer::file;     // of what is laid of the file
  std::vector<PlacedFault> faults_;
};

constexpr std::size_t longest_name = 100;

// the name of a case, or empty with a fault
std::string case_name(const toml::table& table, const std::set<std::string>& taken,
                      Reading& reading) {
  const auto* node = table.get("name");
  const auto place = reading.place_of(node ? node->source() : table.source());
  if (!node) {
    reading.fault(place, "[[case]]: has no name, must have one: name = \"...\"");
    return "";
  }
  const auto name = node->value<std::string>();
  if (const auto wrong = case_name_fault(name.value_or("")); !wrong.empty()) {
    reading.fault(place, fmt::format("[[case]] name = {}: {}", shown(*node), wrong));
    return "";
  }
  if (taken.contains(*name)) {
    reading.fault(place,
                  fmt::format("[[case]] name = {}: used twice, must be unique", shown(*node)));
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
    reading.fault(reading.place_of(node->source()), "case: must be tables, each [[case]]");
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
  for (const Draft& draft : runs) reading.check(draft);
  reading.check_use(runs);
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
                                 const std::string& name, const std::vector<Override>& overrides) {
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    const auto& at = error.source().begin;
    return fail(Fault::bad_input, fmt::format("{}:{}:{}: not TOML: {}", source, at.line, at.column,
                                              error.description()));
  }
  Reading reading(source, std::filesystem::path(source).parent_path());
  auto presets = read_presets(root, name, overrides, reading);
  if (!reading.clean()) return fail(Fault::bad_input, reading.report());
  return presets;
}

Result<Presets> read_preset_file(const std::filesystem::path& file,
                                 const std::vector<Override>& overrides) {
  auto text = read_whole(file, largest_text);
  if (!text) return fail(Fault::bad_input, text.error().message);
  return read_preset_text(*text, file.string(), file.stem().string(), overrides);
}

}  // namespace gridshell::preset
