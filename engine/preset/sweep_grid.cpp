#include "engine/preset/sweep_grid.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <map>

#include "engine/preset/consistency.h"
#include "engine/preset/field_table.h"
#include "engine/preset/materials.h"
#include "engine/preset/toml_reader.h"

namespace gridshell::preset {
namespace {

constexpr double most_runs = 100000;
constexpr int largest_seed = 1 << 30;  // the largest allowed [jitter] seed

const Field& field_of(const std::string& key) {
  const auto dot = key.find('.');
  return *find_field(key.substr(0, dot), key.substr(dot + 1));
}

double combinations(const Sweep& sweep) {
  double count = sweep.seeds;
  for (const SweepAxis& axis : sweep.over) count *= double(axis.values.size());
  return count;
}

bool sweeps(const Sweep& sweep, const std::string& key) {
  return std::ranges::find(sweep.over, key, &SweepAxis::key) != sweep.over.end();
}

/// The values of a point: "rod.diameter_mm = 0.2, actuation.radius_mm = 90.0".
std::string setting(const Sweep& sweep, const SweepPoint& point) {
  std::string text;
  for (std::size_t k = 0; k < sweep.over.size(); ++k)
    text += fmt::format("{}{} = {}", k == 0 ? "" : ", ", sweep.over[k].key, point.values[k]);
  return text;
}

/// Checks the points of one run of the file.
class SweepCheck {
 public:
  SweepCheck(const PresetBuilder& builder, LocatedErrors& errors)
      : builder_(builder), sweep_(builder.preset.sweep), errors_(errors) {}

  void keys_set_elsewhere() {
    for (const SweepAxis& axis : sweep_.over) {
      const Field& field = field_of(axis.key);
      set_elsewhere(axis, name_of(field));
      if (field.key == "file")
        for (const char* key : {"kind", "file_unit", "join_mm", "linkage"})
          set_elsewhere(axis, key_label(field.table == "net" ? "net" : "footprint", key));
      if (field.key != "material") continue;
      for (const char* key : keys_of_material)
        if (!sweeps(sweep_, field.table + "." + key))
          set_elsewhere(axis, key_label(field.table, key));
      const Preset& preset = builder_.preset;
      const Rod& rod = field.table == "rod" ? preset.rod : preset.rod_v;
      if (rod.material != Material::none && std::ranges::count(axis.values, "\"none\"") > 0)
        errors_.add(location("over"),
                    fmt::format("[sweep] over: {}: got \"none\" and {} = \"{}\", expected one of "
                                "the two",
                                axis.key, name_of(field), word_of(rod.material)));
    }
  }

  void points(std::map<std::string, std::string>& idle) {
    const SweepGrid grid({builder_.preset, {}});
    for (std::size_t k = 0; k < grid.size(); ++k) {
      const SweepPoint point = grid.at(k);
      for (const KeyError& conflict : conflicts(point.preset)) {
        const Field& field = *find_field(conflict.table, conflict.key);
        errors_.add(location("over"),
                    fmt::format("[sweep] over: at {}: {} = {}: {}", setting(sweep_, point),
                                conflict.label(), value_text(field, point.preset, conflict.item),
                                conflict.what));
        return;  // one conflict is enough: other points often have the same
      }
      forget_used(point, idle);
    }
  }

 private:
  /// Refuses a key that the axis sets or uses, if a case or the command line set it.
  void set_elsewhere(const SweepAxis& axis, const std::string& key) {
    const auto set = builder_.set_at.find(key);
    if (set == builder_.set_at.end() || set->second.layer == ValueLayer::file) return;
    errors_.add(
        set->second,
        fmt::format(
            "{}: got a value from {}, but [sweep] over {} decides it, expected one of the two", key,
            set->second.layer == ValueLayer::one_case ? "a case" : "the command line", axis.key));
  }

  SourceLocation location(const char* key) const {
    const auto at = builder_.set_at.find(fmt::format("[sweep] {}", key));
    return at == builder_.set_at.end() ? SourceLocation{} : at->second;
  }

  /// Removes from `idle` the keys that have an effect in this run.
  static void forget_used(const SweepPoint& point, std::map<std::string, std::string>& idle) {
    if (idle.empty()) return;
    std::map<std::string, std::string> still;
    for (const KeyError& key : unused_keys(point.preset))
      if (const auto name = key.label(); idle.contains(name)) still[name] = key.what;
    idle = std::move(still);
  }

  const PresetBuilder& builder_;
  const Sweep& sweep_;
  LocatedErrors& errors_;
};

}  // namespace

SweepGrid::SweepGrid(const Presets& presets) : cases_(presets.cases) {
  if (cases_.empty()) cases_.push_back({"", presets.base});
  if (sweep().requested()) size_ = cases_.size() * std::size_t(combinations(sweep()));
}

SweepPoint SweepGrid::at(std::size_t point) const {
  const Sweep& sweep = this->sweep();
  const std::size_t a_case = size_ / cases_.size();
  const Case& one = cases_[point / a_case];
  SweepPoint found{one.name, std::vector<std::string>(sweep.over.size()), 0, one.preset};
  std::size_t rest = point % a_case;
  if (sweep.seeds > 1) {
    found.seed = one.preset.imperfection.seed + int(rest % std::size_t(sweep.seeds));
    found.preset.imperfection.seed = found.seed;
  }
  rest /= std::size_t(sweep.seeds);
  for (std::size_t k = sweep.over.size(); k-- > 0;) {
    const SweepAxis& axis = sweep.over[k];
    found.values[k] = axis.values[rest % axis.values.size()];
    rest /= axis.values.size();
    const auto value = toml::parse("x = " + found.values[k]);
    const Field& field = field_of(axis.key);
    assign(field, *value.get("x"), found.preset, {});
    forget_file_options(name_of(field), found.preset);
  }
  for (auto [table, rod] : {std::pair("rod.", &found.preset.rod), {"rod_v.", &found.preset.rod_v}})
    if (const std::string keys(table); sweeps(sweep, keys + "material"))
      take_material(*rod, Rod(*rod), [&](const char* key) { return sweeps(sweep, keys + key); });
  // the radii of the stills may be outside the path of this point
  found.preset.figure.radii_mm.clear();
  // every point searches with random numbers of its own, which do not depend on the other points
  if (found.preset.jitter.requested() && !sweeps(sweep, "jitter.seed")) {
    int& seed = found.preset.jitter.seed;
    seed = int((std::size_t(seed) + point) % (std::size_t(largest_seed) + 1));
  }
  return found;
}

void check_sweep(const std::vector<PresetBuilder>& runs, LocatedErrors& errors) {
  const PresetBuilder& first = runs.front();
  const Sweep& sweep = first.preset.sweep;
  if (!sweep.requested() || first.faulty.contains("[sweep] over")) return;
  const auto location = [&](const char* key) {
    const auto at = first.set_at.find(fmt::format("[sweep] {}", key));
    return at == first.set_at.end() ? SourceLocation{} : at->second;
  };
  const SourceLocation over = sweep.over.empty() ? location("seeds") : location("over");
  if (const double count = combinations(sweep) * double(runs.size()); count > most_runs)
    return errors.add(over, fmt::format("[sweep] over: got {:.0f} runs, expected at most {:.0f}",
                                        count, most_runs));
  std::map<std::string, std::string> idle;  // swept keys that no point has used yet, and why
  for (const SweepAxis& axis : sweep.over) idle[name_of(field_of(axis.key))] = "";
  const char* drawn = "[imperfection] seed";
  if (sweep.seeds > 1 && idle.contains(drawn))
    errors.add(over, fmt::format("[sweep] seeds = {}: {} is swept too, expected one of the two",
                                 sweep.seeds, drawn));
  if (sweep.seeds > 1) idle[drawn] = "";
  for (const PresetBuilder& run : runs) {
    SweepCheck check(run, errors);
    check.keys_set_elsewhere();
    check.points(idle);
  }
  for (const auto& [key, why] : idle)
    if (!why.empty())
      errors.add(key == drawn ? location("seeds") : over,
                 fmt::format("[sweep] over: {} has no effect in any of the runs: {}", key, why));
}

}  // namespace gridshell::preset
