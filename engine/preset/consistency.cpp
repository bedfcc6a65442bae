#include "engine/preset/consistency.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <span>
#include <utility>

#include "engine/core/text.h"
#include "engine/formats/network_file.h"
#include "engine/preset/preset.h"

namespace gridshell::preset {

namespace {

std::span<const RodValue> own_of(const NetworkData& network, int number) {
  // not by equal_range, which clang 14 does not compile
  const auto first = std::ranges::lower_bound(network.own, number, {}, &RodValue::rod),
             last = std::ranges::upper_bound(network.own, number, {}, &RodValue::rod);
  return {first, last};
}

/// Sets a key of [rod] to a value of a network file. Returns the error, or an empty text.
std::string put_own(const RodValue& own, Preset& preset) {
  const auto is_own = [&](const Field& field) {
    return field.table == "rod" && field.key != "diameter_mm" &&
           (field.as<bool>(preset) || field.as<double>(preset));
  };
  const Field* field = find_field("rod", own.key);
  if (!field || !is_own(*field)) {
    std::vector<std::string> known{"points", "diameter_mm"};
    for (const Field& one : field_table())
      if (is_own(one)) known.push_back(one.key);
    std::erase(known, own.key);
    return fmt::format(
        "got an unknown key '{}', expected points, diameter_mm or another key of [rod] that is a "
        "number "
        "or "
        "true or false{}",
        own.key, did_you_mean(own.key, known));
  }
  bool* flag = field->as<bool>(preset);
  const bool fits = flag ? own.value == 0 || own.value == 1 : field->range.contains(own.value);
  if (!fits) return fmt::format("{}: got {:g}, expected {}", own.key, own.value, allowed(*field));
  if (const auto wrong = magnitude_error(own.value); !wrong.empty())
    return got_text(own.key, fmt::format("{:g}", own.value), wrong);
  if (flag)
    *flag = own.value == 1;
  else
    *field->as<double>(preset) = own.value;
  return "";
}

/// The different [rod] of a network's rods with values of their own, each with the index of the
/// first such rod.
std::vector<std::pair<int, Rod>> rods_of_their_own(const Preset& preset) {
  std::vector<std::pair<int, Rod>> found;
  if (preset.footprint.kind != FootprintKind::network) return found;
  int last = -1;
  for (const RodValue& own : preset.footprint.file.own) {
    if (std::exchange(last, own.rod) == own.rod) continue;
    const Rod rod = rod_of_network(preset, own.rod);
    if (std::ranges::none_of(found, [&](const auto& known) { return known.second == rod; }))
      found.emplace_back(own.rod, rod);
  }
  return found;
}

/// Adds errors of the rules of [rod] for the rods of a network with values of their own.
void look_at_own_rods(const Preset& preset, RuleKind kind, std::vector<KeyError>& found) {
  const auto rods = rods_of_their_own(preset);
  if (rods.empty() || kind == RuleKind::unused) return;
  Preset one = preset;
  one.footprint.file.own.clear();
  for (const auto& [number, rod] : rods) {
    one.rod = rod;
    for (const Field& field : field_table())
      for (const Rule& rule : field.rules) {
        if (field.table != "rod" || rule.kind != kind) continue;
        if (const auto what = rule.fault(one, -1); !what.empty())
          found.push_back({"footprint",
                           "file",
                           -1,
                           {},
                           fmt::format("rods[{}] {}: {}", number, field.key, what)});
      }
  }
}

std::string list_of(const std::vector<KeyError>& needs) {
  std::vector<std::string> all;
  for (const auto& need : needs)
    if (std::ranges::find(all, need.what) == all.end()) all.push_back(need.what);
  return fmt::format("{}", fmt::join(all, ", and "));
}

/// Keys that the requested rod model does not support, and rods without the torsional stiffness
/// that it needs.
std::vector<KeyError> model_conflicts(const Preset& preset) {
  std::vector<KeyError> found;
  const RodModel requested = preset.accuracy.model;
  auto unmet = requested == RodModel::net ? key_errors(preset, RuleKind::needs_equilibrium)
                                          : std::vector<KeyError>();
  if (requested == RodModel::net || requested == RodModel::bend)
    for (auto& need : key_errors(preset, RuleKind::needs_twist)) unmet.push_back(std::move(need));
  for (const KeyError& need : unmet)
    found.push_back({"accuracy",
                     "model",
                     -1,
                     {need.label()},
                     fmt::format("it cannot compute {}: {}", need.label(), need.what)});
  if (rod_model_of(preset) != RodModel::twist) return found;
  const auto needs = key_errors(preset, RuleKind::needs_twist);
  const KeyError cause =
      needs.empty() ? KeyError{"accuracy", "model", -1, {}, "the model is given"} : needs.front();
  const auto check = [&](const Rod& rod, const std::string& table) {
    if (rod.shear_GPa == 0 && rod.GJ_Nmm2 == 0)
      found.push_back({cause.table,
                       cause.key,
                       -1,
                       {fmt::format("{} shear_GPa", table)},
                       fmt::format("the rods twist: {}; they have no torsional stiffness, expected "
                                   "{} shear_GPa or GJ_Nmm2 above 0",
                                   cause.what, table)});
  };
  check(preset.rod, "[rod]");
  if (preset.rod_v.differs) check(preset.rod_v, "[rod_v]");
  if (preset.rod.shear_GPa > 0 || preset.rod.GJ_Nmm2 > 0)
    for (const auto& [number, rod] : rods_of_their_own(preset))
      check(rod, fmt::format("rods[{}]", number));
  return found;
}

}  // namespace

Rod rod_of_network(const Preset& preset, int number, bool reversed) {
  const NetworkData& file = preset.footprint.file;
  Preset one;
  one.rod = preset.rod;
  for (RodValue own : own_of(file, number)) {
    if (reversed && own.key == "curvature_sideways_per_mm") own.value *= -1;
    put_own(own, one);
  }
  const double diameter = file.diameters.empty() ? 0 : file.diameters[std::size_t(number)];
  if (diameter > 0) one.rod.diameter_mm = diameter;
  return one.rod;
}

std::string own_value_error(const NetworkData& network) {
  Preset any;
  for (const RodValue& own : network.own)
    if (const auto wrong = put_own(own, any); !wrong.empty())
      return fmt::format("rods[{}]: {}", own.rod, wrong);
  return "";
}

std::vector<KeyError> key_errors(const Preset& preset, RuleKind kind) {
  std::vector<KeyError> found;
  const auto look = [&](const Field& field, int item) {
    for (const Rule& rule : field.rules) {
      if (rule.kind != kind) continue;
      auto what = rule.fault(preset, item);
      if (what.empty()) continue;
      found.push_back({field.table, field.key, item, {}, std::move(what)});
      for (const auto& other : rule.others)
        found.back().others.push_back(full_label(field.table, other, item));
      if (kind == RuleKind::unused) return;
    }
  };
  for (const Field& field : field_table()) {
    if (field.rules.empty()) continue;
    const auto items = items_of(preset, field.table);
    if (!items) look(field, -1);
    for (int item = 0; item < items.value_or(0); ++item) look(field, item);
  }
  look_at_own_rods(preset, kind, found);
  return found;
}

std::vector<KeyError> conflicts(const Preset& preset) {
  auto found = key_errors(preset, RuleKind::refused);
  for (auto& fault : model_conflicts(preset)) found.push_back(std::move(fault));
  return found;
}

std::vector<KeyError> unused_keys(const Preset& preset) {
  return key_errors(preset, RuleKind::unused);
}

std::vector<std::string> doubtful_values(const Preset& preset) {
  constexpr double stiffest_GPa = 1300, densest_kg_m3 = 23000;  // diamond, osmium
  std::vector<std::string> found;
  const auto look = [&](const Rod& rod, const std::string& table) {
    for (const auto& [key, value] :
         {std::pair("young_GPa", rod.young_GPa), {"shear_GPa", rod.shear_GPa}})
      if (value > stiffest_GPa)
        found.push_back(
            fmt::format("{} {} = {:g}: stiffer than any material, given in MPa? {:g} GPa", table,
                        key, value, value / 1000));
    if (rod.density_kg_m3 > densest_kg_m3)
      found.push_back(fmt::format("{} density_kg_m3 = {:g}: denser than any material", table,
                                  rod.density_kg_m3));
  };
  look(preset.rod, "[rod]");
  if (preset.rod_v.differs) look(preset.rod_v, "[rod_v]");
  const bool network = preset.footprint.kind == FootprintKind::network;
  const double spacing = network ? spacing_of(preset.footprint.file) : preset.footprint.spacing_mm;
  // joints without a given diameter have at least 3 mm
  if (const double across = preset.joints.diameter_mm.value_or(3); spacing > 0 && across > spacing)
    found.push_back(fmt::format(
        "[joints] diameter_mm = {:g}: joints are larger than their usual distance of {:.3g} mm",
        across, spacing));
  return found;
}

std::optional<NamedSide> side_named(const Preset& preset, const std::string& name) {
  for (int k = 0; k < int(preset.block.size()); ++k)
    for (const char* side : side_names)
      if (name == preset.block[std::size_t(k)].name + "." + side) return NamedSide{k, side};
  return std::nullopt;
}

RodModel rod_model_of(const Preset& preset) {
  if (preset.accuracy.model != RodModel::automatic) return preset.accuracy.model;
  const bool twist = !key_errors(preset, RuleKind::needs_twist).empty();
  const bool cap = preset.footprint.kind == FootprintKind::net &&
                   preset.net.kind == NetKind::sphere && preset.ends.kind == EndKind::pinned;
  if (!twist && cap && key_errors(preset, RuleKind::needs_equilibrium).empty())
    return RodModel::net;
  return twist ? RodModel::twist : RodModel::bend;
}

std::string model_reason(const Preset& preset) {
  switch (rod_model_of(preset)) {
    case RodModel::net:
      return fmt::format(
          "net: the tolerance of {:g} allows the smooth net itself, and nothing is requested that "
          "needs "
          "an equilibrium; none is solved for, so there is no residual, and stability is not known",
          preset.accuracy.tolerance);
    case RodModel::twist: {
      const auto needs = key_errors(preset, RuleKind::needs_twist);
      return needs.empty()
                 ? "twist, as requested: every rod's torsion is in it; `bend` would give the same "
                   "shape, "
                   "as nothing twists these rods"
                 : fmt::format("twist: {}; nothing is left out, the torsion of every rod is in it",
                               list_of(needs));
    }
    case RodModel::automatic:  // rod_model_of() never returns it
    case RodModel::bend:
      break;
  }
  return fmt::format(
      "bend: the rods are round and naturally straight, their ends spin freely and the joints pass "
      "no twist, so the twist energy is zero in equilibrium and leaving it out changes nothing; "
      "joints "
      "are {}",
      preset.joints.eccentricity_mm == 0 ? "shared nodes, the limit of stiff springs"
                                         : "bolts between the axes of rods at a distance");
}

std::string joints_against(const Preset& preset) {
  const bool opens = std::ranges::any_of(preset.step, [](const Step& step) {
    return step.kind == StepKind::open && step.angles.empty();
  });
  if (!opens || preset.footprint.kind != FootprintKind::network) return "";
  const NetworkData& file = preset.footprint.file;
  const std::vector<int> against = opening_sense(file).against;
  if (against.empty()) return "";
  std::vector<std::size_t> rods;
  for (std::size_t r = 0; r < file.rods.size(); ++r)
    if (std::ranges::count(file.rods[r], against.front()) > 0) rods.push_back(r);
  return fmt::format(
      "an open turns {} joints, [{}, 0] first, against the others: rods[{}] and rods[{}] there run "
      "so that its angle grows on the other side; the points of one of them must be reversed",
      against.size(), against.front(), rods.front(), rods.back());
}

}  // namespace gridshell::preset
