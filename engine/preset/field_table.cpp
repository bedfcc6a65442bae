#include "engine/preset/field_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/preset/field_list.h"

namespace gridshell::preset {

std::string magnitude_error(double value) {
  const double size = std::abs(value);
  if (size == 0 || (size >= least_magnitude && size <= largest_magnitude)) return "";
  return std::string(size > 1 ? "too large" : "too small") +
         " to compute with, expected 0, or a magnitude of 1e-9 to 1e9";
}

std::string key_label(const std::string& table, const std::string& key, int item) {
  if (item >= 0) return fmt::format("[[{}]] {} {}", table, item + 1, key);
  return table.empty() ? key : fmt::format("[{}] {}", table, key);
}

std::string name_of(const Field& field) { return key_label(field.table, field.key); }

std::string full_label(const std::string& table, const std::string& key, int item) {
  return key.starts_with('[') ? key : key_label(table, key, item);
}

std::string unit_of(const std::string& key) {
  // longer endings first: "_rad_per_mm" ends with "_per_mm", too
  static constexpr std::pair<const char*, const char*> units[] = {{"_rad_per_mm", "rad/mm"},
                                                                  {"_N_per_mm", "N/mm"},
                                                                  {"_per_mm", "1/mm"},
                                                                  {"_per_s", "1/s"},
                                                                  {"_kg_m3", "kg/m^3"},
                                                                  {"_m_s2", "m/s^2"},
                                                                  {"_N_m2", "N/m^2"},
                                                                  {"_N_m", "N/m"},
                                                                  {"_Nmm2", "N mm²"},
                                                                  {"_Nmm", "N mm/rad"},
                                                                  {"_GPa", "GPa"},
                                                                  {"_MPa", "MPa"},
                                                                  {"_GB", "GB"},
                                                                  {"_deg", "deg"},
                                                                  {"_mm3", "mm^3"},
                                                                  {"_mm", "mm"},
                                                                  {"_mJ", "mJ"},
                                                                  {"_g_per_m", "g/m"},
                                                                  {"_g", "g"},
                                                                  {"_N", "N"},
                                                                  {"_s", "s"}};
  for (const auto& [ending, unit] : units)
    if (key.ends_with(ending)) return unit;
  return "";
}

std::string without_unit(const std::string& key, std::string_view unit) {
  std::size_t end = key.size();
  for (std::size_t k = 0; k < key.size() && !unit.empty(); ++k)
    if (key[k] == '_' && unit_of(key.substr(k)) == unit) end = k;
  return key.substr(0, end);
}

AnyFieldList::AnyFieldList(std::vector<Field>& all, std::string table, StructOf of)
    : all_(all), table_(std::move(table)), of_(std::move(of)) {}

void AnyFieldList::add(std::string key, std::string_view meaning, Range range,
                       std::vector<std::string> words, Member (*member)(void* one)) {
  if (first_key_.empty()) first_key_ = key;
  all_.push_back(
      {.table = table_,
       .key = key,
       .unit = unit_of(key),
       .meaning = std::string(meaning),
       .in = [of = of_, member](Preset& preset, int item) { return member(of(preset, item)); },
       .range = range,
       .words = std::move(words),
       .rules = common_});
}

void AnyFieldList::rename(std::string key) {
  if (first_key_ == all_.back().key) first_key_ = key;
  all_.back().key = std::move(key);
}

void AnyFieldList::add_rule(Rule rule) {
  auto& rules = first_key_.empty() ? common_ : all_.back().rules;
  rules.push_back(std::move(rule));
}

void AnyFieldList::add_rule(RuleKind kind, Keys others, Fault fault) {
  add_rule({kind,
            {others.begin(), others.end()},
            [of = of_, where = where_, fault = std::move(fault)](const Preset& preset, int item) {
              if (where && !where(preset)) return std::string();
              // the function gets a preset that can be written to; nothing is written
              return fault(preset, of(const_cast<Preset&>(preset), item));
            }});
}

void AnyFieldList::add_rule(RuleKind kind, Keys others, std::string_view what,
                            Condition condition) {
  add_rule(
      kind, others,
      [what = std::string(what), condition = std::move(condition)](
          const Preset& preset, const void* one) { return condition(preset, one) ? what : ""; });
}

void AnyFieldList::use_only(std::string_view decider, WordOf word, std::vector<std::string> users) {
  const std::string key(decider);
  add_rule({RuleKind::unused,
            {key},
            [=, of = of_, where = where_, table = table_](const Preset& preset,
                                                          int item) -> std::string {
              const auto found = word(preset, of(const_cast<Preset&>(preset), item));
              if ((where && !where(preset)) || std::ranges::find(users, found) != users.end())
                return "";
              return fmt::format("{} = \"{}\" does not use it, only {}",
                                 full_label(table, key, item), found, words_text(users));
            }});
}

const std::vector<Table>& tables() {
  static const std::vector<Table> all = {
      {"", "What the preset is."},
      {"rod", "The rods' material and section."},
      {"rod_v", "The v-rods, where they differ from the u-rods."},
      {"joints", "What connects crossing rods."},
      {"ends", "How the rods' ends are fixed on the boundary."},
      {"footprint", "The flat, unloaded grid."},
      {"net", "The net that the footprint is designed on, for footprints of kind \"net\"."},
      {"blocks", "How building blocks must meet, for footprints of kind \"blocks\"."},
      {"block", "A building block: a net and where it is cut.", true},
      {"join", "Two sides of blocks that become one seam.", true},
      {"actuation", "How the boundary moves: every edge point straight and evenly."},
      {"imperfection", "What selects the branch of a shell that loses its stability."},
      {"indentation", "The push at one joint of the actuated shell."},
      {"step", "What is done to the actuated shell, one step after the other.", true},
      {"loads", "What loads the shell, in addition to its boundary."},
      {"loads.case",
       "Loads on the formed shell, by `[[step]]` or in `gridshell load`, in addition to those "
       "under "
       "which it was formed: dead forces, evaluated on the shape at which they are applied.",
       true},
      {"dynamics", "How a shell moves after it lost its stability."},
      {"limits", "Where the model stops being valid."},
      {"contact", "Whether rods that touch press on each other."},
      {"inverse", "What `gridshell design` changes so that the shell meets its surface."},
      {"accuracy", "How exact the result must be."},
      {"jitter", "How the states of a shell are searched for."},
      {"sweep", "Many runs with other values, for `gridshell sweep`."},
      {"movie", "The frames of `gridshell movie` and their camera."},
      {"style", "How pictures look."},
      {"figure", "The stills of `gridshell figure`."},
      {"page", "A page that shows a figure of the paper, for `gridshell figure`."},
  };
  return all;
}

const std::vector<Field>& field_table() {
  static const std::vector<Field> all = [] {
    std::vector<Field> fields;
    FieldList<Preset> top(fields, "", [](Preset& preset) -> Preset& { return preset; });
    top.add<&Preset::title>("one line that names the experiment");
    top.add<&Preset::description>("what it shows and what was chosen");
    top.add<&Preset::source>("figure or movie of the paper it follows");
    top.add<&Preset::allow_unstable>("whether a run may end in an unstable state without failing");
    add_shape_fields(fields);
    add_net_fields(fields);
    add_rod_fields(fields);
    add_experiment_fields(fields);
    add_picture_fields(fields);
    return fields;
  }();
  return all;
}

std::vector<std::string> keys_of(const std::string& table) {
  std::vector<std::string> keys;
  for (const auto& field : field_table())
    if (field.table == table) keys.push_back(field.key);
  return keys;
}

const Field* find_field(const std::string& table, const std::string& key) {
  for (const auto& field : field_table())
    if (field.table == table && field.key == key) return &field;
  return nullptr;
}

}  // namespace gridshell::preset
