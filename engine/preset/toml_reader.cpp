#include "engine/preset/toml_reader.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>

#include "engine/core/text.h"

namespace gridshell::preset {

bool is_list_name(const std::string& name) {
  return std::ranges::any_of(tables(),
                             [&](const Table& table) { return table.list && table.name == name; });
}

namespace {

std::vector<std::string> table_names() {
  std::vector<std::string> names{"case"};
  for (const auto& table : tables())
    if (!table.name.empty()) names.push_back(table.name);
  return names;
}

bool is_table_name(const std::string& name) {
  const auto names = table_names();
  return name != "case" && !is_list_name(name) && std::ranges::find(names, name) != names.end();
}

toml::table override_value(const std::string& value) {
  try {
    auto parsed = toml::parse("x = " + value);
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {
  }
  return toml::table{{"x", value}};
}

// hint for an unknown key: a similar key of its table, the same key of another table, or else all
// keys of its table
std::string hint(const std::string& table, const std::string& name) {
  const auto here = keys_of(table);
  for (const Table& whole : tables())
    if (table.empty() && !name.empty() && whole.name == name)
      return fmt::format("; it is a table, whose keys are set one by one, as {}.{}{}", name,
                         whole.list ? "1." : "", keys_of(name).front());
  if (const auto near = did_you_mean(name, here); !near.empty()) return near;
  for (const auto& field : field_table())
    if (field.key == name)
      return fmt::format("; did you mean '{}{}{}'?", field.table, field.table.empty() ? "" : ".",
                         name);
  return fmt::format(", expected one of {}", fmt::join(here, ", "));
}

constexpr std::int64_t most_values = 100000;

/// One swept key as it is written.
struct Entry {
  std::string table, key;
  toml::source_region location;
  const toml::node* value;

  std::string name() const { return table.empty() ? key : table + "." + key; }
};

/// The entries in the order of the file; a toml::table sorts them by name.
std::vector<Entry> entries_of(const toml::table& over) {
  std::vector<Entry> entries;
  for (const auto& [key, node] : over) {
    const auto* inner = node.as_table();
    if (!inner) {
      // "rod.diameter_mm" in quotes is one key to TOML
      const std::string_view name = key.str();
      const std::size_t dot = std::min(name.find('.'), name.size());
      const bool quoted = dot < name.size();
      entries.push_back({std::string(name.substr(0, quoted ? dot : 0)),
                         std::string(name.substr(quoted ? dot + 1 : 0)), key.source(), &node});
      continue;
    }
    for (const auto& [name, value] : *inner)
      entries.push_back({std::string(key.str()), std::string(name.str()), name.source(), &value});
  }
  std::ranges::sort(entries, {}, [](const Entry& entry) {
    return std::tuple(entry.location.begin.line, entry.location.begin.column);
  });
  return entries;
}

/// Whether a name is that of a list of tables or of a key in one: "step", "step.2.depth_mm".
bool in_list(const std::string& name) {
  return std::ranges::any_of(tables(), [&](const Table& table) {
    return table.list && (name == table.name || name.starts_with(table.name + "."));
  });
}

/// Whether a key may name a file instead of its contents.
bool takes_file(const Field& field) {
  Preset any = default_items();  // only the type of the member matters
  return field.as<Points>(any) || field.as<SurfaceData>(any) || field.as<NetworkData>(any);
}

/// Whether keys of a table can change the results of a run: those of pictures and of the sweep
/// itself cannot.
bool affects_results(const std::string& table) {
  static const std::vector<std::string> others{"", "sweep", "movie", "style", "figure", "page"};
  return std::ranges::find(others, table) == others.end();
}

/// Reads one entry as an axis of a sweep.
class AxisReader {
 public:
  /// Files are read by the other keys of `preset`, and searched for as `context` says.
  AxisReader(const Entry& entry, const Preset& preset, const FileContext& context,
             std::vector<AxisError>& errors)
      : entry_(entry), preset_(preset), context_(context), errors_(errors) {}

  std::optional<SweepAxis> read() {
    const std::size_t before = errors_.size();
    field_ = find_field(entry_.table, entry_.key);
    if (in_list(entry_.name())) {
      refuse(*entry_.value, "each item of a list has this key, expected a key that exists once");
    } else if (!field_) {
      std::vector<std::string> names;
      for (const auto& field : field_table())
        if (affects_results(field.table) && !in_list(field.table))
          names.push_back(field.table + "." + field.key);
      refuse(*entry_.value, "unknown key" + did_you_mean(entry_.name(), names));
    } else if (!affects_results(entry_.table)) {
      refuse(*entry_.value, "no number of a run depends on it, expected a key of another table");
    } else if (const auto* list = entry_.value->as_array()) {
      if (list->empty()) refuse(*list, "an empty list, expected values");
      for (const auto& value : *list) take(value);
    } else if (const auto* range = entry_.value->as_table()) {
      take_range(*range);
    } else {
      refuse(*entry_.value, "expected a list of values or { from, to, count }");
    }
    if (errors_.size() > before) return std::nullopt;
    return SweepAxis{entry_.name(), std::move(values_)};
  }

 private:
  void refuse(const toml::node& value, const std::string& why) {
    const auto& region = value.source();
    // a computed value has no position in the file
    errors_.push_back({region.begin.line > 0 ? region : entry_.location,
                       got_text("[sweep.over] " + entry_.name(), toml_text(value), why)});
  }

  void take(const toml::node& value) {
    if (const auto wrong = assign(*field_, value, preset_, context_); !wrong.empty())
      return refuse(value, wrong);
    auto text = value_text(*field_, preset_);
    if (!taken_.insert(text).second)
      return refuse(value, "in the list twice, expected another value");
    values_.push_back(std::move(text));
  }

  void take_range(const toml::table& range) {
    static const std::vector<std::string> known{"from", "to", "count", "log"};
    for (const auto& [key, value] : range)
      if (const std::string name(key.str()); std::ranges::find(known, name) == known.end())
        return refuse(range, fmt::format("unknown '{}'{}, expected {{ from, to, count }}", name,
                                         did_you_mean(name, known)));
    const auto from = range["from"].value<double>(), to = range["to"].value<double>();
    const auto count = range["count"].as_integer();
    const bool log = range["log"].value_or(false);
    if (!from || !to || !count || !std::isfinite(*from) || !std::isfinite(*to))
      return refuse(range, "expected { from = a number, to = a number, count = an integer }");
    if (count->get() < 2 || count->get() > most_values)
      return refuse(range, fmt::format("count: expected 2 to {}", most_values));
    if (range.contains("log") && !range["log"].is_boolean())
      return refuse(range, "log: expected true or false");
    if (log && !(*from > 0 && *to > 0))
      return refuse(range, "log = true: expected from and to above 0");
    for (std::int64_t k = 0; k < count->get(); ++k) {
      const double part = double(k) / double(count->get() - 1);
      const double value = log ? *from * std::pow(*to / *from, part) : *from + part * (*to - *from);
      take_number(value, range);
    }
  }

  void take_number(double value, const toml::table& range) {
    // 12 digits: three steps of 0.1 give 0.3, not 0.30000000000000004
    value = parse_number<double>(fmt::format("{:.12g}", value)).value_or(value);
    Preset any = default_items();
    if (!field_->as<int>(any)) return take(toml::value<double>(value));
    if (value != std::round(value) || std::abs(value) > 1e9)
      return refuse(range, fmt::format("gives {}, expected {}", value, allowed(*field_)));
    take(toml::value<std::int64_t>(std::int64_t(value)));
  }

  const Entry& entry_;
  Preset preset_;
  const FileContext& context_;
  std::vector<AxisError>& errors_;
  const Field* field_ = nullptr;
  std::vector<std::string> values_;
  std::set<std::string> taken_;
};

/// The axes in the order of the file. Errors are added to `errors`, and an axis with an error is
/// left out. Each value was assigned to its key once and is in range.
std::vector<SweepAxis> read_axes(const toml::table& over, const Preset& preset,
                                 const FileContext& context, std::vector<AxisError>& errors) {
  std::vector<SweepAxis> axes;
  for (const Entry& entry : entries_of(over))
    if (auto axis = AxisReader(entry, preset, context, errors).read())
      axes.push_back(std::move(*axis));
  return axes;
}

}  // namespace

SourceLocation TomlReader::location_of(const toml::source_region& region) const {
  // values of an override have no position in the file
  if (!override_.empty()) return {override_, 0, 0, ValueLayer::command_line};
  return {source_, unsigned(region.begin.line), unsigned(region.begin.column), layer_};
}

void TomlReader::apply(const toml::table& root, const std::string& apart, PresetBuilder& builder) {
  layer_ = apart == "case" ? ValueLayer::file : ValueLayer::one_case;
  for (const auto& [key, value] : root) {
    const std::string name(key.str());
    if (name == apart) continue;
    if (is_list_name(name))
      read_items(name, key, value, builder);
    else if (!is_table_name(name) && !value.is_table())
      assign_key("", key, value, builder);
    else
      read_table(key, value, builder);
  }
}

void TomlReader::apply_override(const Override& change, PresetBuilder& builder) {
  override_ = change.source;
  for (const Table& list : tables())
    if (list.list && change.key.starts_with(list.name + ".")) {
      override_item(list.name, change, builder);
      return override_.clear();
    }
  const auto dot = change.key.find('.');
  const bool top = dot == std::string::npos;
  const auto table = top ? "" : change.key.substr(0, dot);
  const auto name = top ? change.key : change.key.substr(dot + 1);
  const auto value = override_value(change.value);
  if (!top && !is_table_name(table))
    errors_.add({override_}, fmt::format("[{}] {}: unknown table{}", table, name,
                                         did_you_mean(table, table_names())));
  else
    assign_key(table, toml::key(name), *value.get("x"), builder);
  override_.clear();
}

/// Sets a key of an item of a list of tables, which is named by its number from 1:
/// step.2.depth_mm.
void TomlReader::override_item(const std::string& list, const Override& change,
                               PresetBuilder& builder) {
  const std::string rest = change.key.substr(list.size() + 1);
  const auto dot = std::min(rest.find('.'), rest.size());
  const int items = items_of(builder.preset, list).value_or(0);
  int item = 0;
  const auto [end, wrong] = std::from_chars(rest.data(), rest.data() + dot, item);
  if (wrong != std::errc() || end != rest.data() + dot || item < 1 || item > items)
    return errors_.add({override_},
                       fmt::format("{}: got {} [[{}]], expected the number of one, as {}.1.{}",
                                   change.key, items, list, list, keys_of(list).front()));
  const auto value = override_value(change.value);
  assign_key(list, toml::key(dot < rest.size() ? rest.substr(dot + 1) : ""), *value.get("x"),
             builder, item - 1);
}

// reads a list of tables; the items of a case replace those of the file, an empty list removes them
void TomlReader::read_items(const std::string& name, const toml::key& key, const toml::node& value,
                            PresetBuilder& builder) {
  const bool none = value.is_array() && value.as_array()->empty();
  if (!value.is_array_of_tables() && !none) {
    errors_.add(location_of(key.source()),
                fmt::format("{}: expected tables, each [[{}{}]]", name,
                            layer_ == ValueLayer::one_case ? "case." : "", name));
    return;
  }
  builder.forget_items(name);
  int item = 0;
  for (const auto& table : *value.as_array()) {
    add_item(builder.preset, name);
    builder.set_at[key_label(name, "", item)] = location_of(table.source());
    for (const auto& [inner, one] : *table.as_table()) assign_key(name, inner, one, builder, item);
    ++item;
  }
}

void TomlReader::read_table(const toml::key& key, const toml::node& value, PresetBuilder& builder) {
  const std::string name(key.str());
  const auto location = location_of(key.source());
  if (!is_table_name(name)) {
    errors_.add(location,
                fmt::format("[{}]: unknown table{}", name, did_you_mean(name, table_names())));
  } else if (const auto* table = value.as_table()) {
    for (const auto& [inner, item] : *table)
      if (const auto list = fmt::format("{}.{}", name, inner.str()); is_list_name(list))
        read_items(list, inner, item, builder);
      else
        assign_key(name, inner, item, builder);
  } else {
    errors_.add(location, fmt::format("{}: got {}, expected a table of keys: {}", name,
                                      toml_text(value), fmt::join(keys_of(name), ", ")));
  }
}

FileContext TomlReader::context() const { return override_.empty() ? context_ : FileContext{}; }

void TomlReader::read_sweep_axes(const toml::table& over, PresetBuilder& builder) {
  std::vector<AxisError> wrong;
  builder.preset.sweep.over = read_axes(over, builder.preset, context(), wrong);
  for (auto& fault : wrong) errors_.add(location_of(fault.location), std::move(fault.text));
  if (!wrong.empty()) builder.faulty.insert("[sweep] over");
}

void TomlReader::assign_key(const std::string& table, const toml::key& key, const toml::node& value,
                            PresetBuilder& builder, int item) {
  const std::string name(key.str());
  const auto* field = find_field(table, name);
  const auto full = key_label(table, name, item);
  if (!field) {
    errors_.add(location_of(key.source()),
                fmt::format("{}: unknown key{}", full, hint(table, name)));
    return;
  }
  const auto location = location_of(value.source());
  if (table == "sweep" && location.layer == ValueLayer::one_case) {
    errors_.add(
        location,
        full + ": got a key of a case, expected one outside of cases: a sweep runs all of them");
    return;
  }
  if (value.is_table() && field->as<std::vector<SweepAxis>>(builder.preset)) {
    builder.set_at[full] = location_of(key.source());
    read_sweep_axes(*value.as_table(), builder);
    return;
  }
  builder.set_at[full] = location;
  const FileContext context = this->context();
  builder.files.erase(full);
  if (const auto* file = value.as_string(); file && !file->get().empty() && takes_file(*field)) {
    builder.faulty.erase(full);
    builder.files[full] = {table, name, item, file->get(), context};
    return;
  }
  const auto wrong = assign(*field, value, builder.preset, context, item);
  if (wrong.empty()) {
    builder.faulty.erase(full);
    if (table.starts_with("rod")) assign(*field, value, builder.given, context);
    // yield_strain may be set after material, and replaces its strength
    if (table.starts_with("rod") && (name == "material" || name == "yield_strain"))
      builder.take_material(table);
  } else {
    builder.faulty.insert(full);
    errors_.add(location, got_text(full, toml_text(value), wrong));
  }
}

void TomlReader::read_files(PresetBuilder& builder) {
  for (const auto& [full, file] : builder.files) {
    const auto* field = find_field(file.table, file.key);
    const toml::value<std::string> value(file.name);
    FileReport report;
    const auto wrong = assign(*field, value, builder.preset, file.context, file.item, &report);
    if (!report.text.empty()) builder.read.push_back(full + " = " + report.text);
    for (const std::string& note : report.notes) builder.notes.push_back(full + ": " + note);
    if (wrong.empty()) continue;
    builder.faulty.insert(full);
    errors_.add(builder.set_at.at(full), full + ": " + wrong);  // names the file
  }
  for (const auto& [full, file] : builder.files) forget_file_options(full, builder.preset);
}

void forget_file_options(const std::string& key, Preset& preset) {
  if (key == "[footprint] file" || key == "[actuation] file") {
    preset.footprint.file_unit = FileUnit::file;
    preset.footprint.join_mm = 0;
    preset.footprint.linkage = false;
  }
  if (key == "[net] file") preset.net.file_unit = FileUnit::file;
}

}  // namespace gridshell::preset
