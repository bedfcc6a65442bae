#include "engine/preset/model_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace gridshell::preset {
namespace {

std::string label_of(const KeyFault& fault) {
  return key_label(fault.table, fault.key, fault.item);
}

/// Why the `bend` rung (stretch and bend of rods that spin freely, on shared joints) would not be
/// exact. Empty: it is.
std::vector<KeyFault> twist_needs(const Preset& preset) {
  return key_faults(preset, RuleKind::needs_twist);
}

/// Why the `net` rung (the smooth net itself) is not enough: what needs an equilibrium. Empty: a
/// net is all that is asked for.
std::vector<KeyFault> equilibrium_needs(const Preset& preset) {
  return key_faults(preset, RuleKind::needs_equilibrium);
}

std::string list_of(const std::vector<KeyFault>& needs) {
  std::vector<std::string> all;
  for (const auto& need : needs)
    if (std::ranges::find(all, need.what) == all.end()) all.push_back(need.what);
  return fmt::format("{}", fmt::join(all, ", and "));
}

}  // namespace

RodModel rod_model_of(const Preset& preset) {
  if (preset.accuracy.model != RodModel::automatic) return preset.accuracy.model;
  const bool twist = !twist_needs(preset).empty();
  const bool cap = preset.footprint.kind == FootprintKind::net &&
                   preset.net.kind == NetKind::sphere && preset.ends.kind == EndKind::pinned;
  if (!twist && cap && equilibrium_needs(preset).empty()) return RodModel::net;
  return twist ? RodModel::twist : RodModel::bend;
}

std::string model_reason(const Preset& preset) {
  switch (rod_model_of(preset)) {
    case RodModel::net:
      return fmt::format(
          "net: the tolerance of {:g} allows the smooth net itself, and nothing is asked that "
          "needs "
          "an equilibrium; none is solved for, so there is no residual and no word on stability",
          preset.accuracy.tolerance);
    case RodModel::twist: {
      const auto needs = twist_needs(preset);
      return needs.empty()
                 ? "twist, as asked: every rod's torsion is in it; `bend` would give the same "
                   "shape, "
                   "as nothing twists these rods"
                 : fmt::format("twist: {}; nothing is left out, the torsion of every rod is in it",
                               list_of(needs));
    }
    case RodModel::automatic:  // the rung is a choice made
    case RodModel::bend:
      break;
  }
  return "bend: the rods are round and naturally straight, their ends spin freely and the "
         "joints pass no twist, so the twist energy is zero at rest and leaving it out changes "
         "nothing; joints are shared nodes, the limit of stiff springs";
}

std::vector<KeyFault> model_conflicts(const Preset& preset) {
  std::vector<KeyFault> found;
  const RodModel asked = preset.accuracy.model;
  auto unmet = asked == RodModel::net ? equilibrium_needs(preset) : std::vector<KeyFault>();
  if (asked == RodModel::net || asked == RodModel::bend)
    for (auto& need : twist_needs(preset)) unmet.push_back(std::move(need));
  for (const KeyFault& need : unmet)
    found.push_back({"accuracy",
                     "model",
                     -1,
                     {label_of(need)},
                     fmt::format("cannot serve {}: {}", label_of(need), need.what)});
  if (rod_model_of(preset) != RodModel::twist) return found;
  const auto needs = twist_needs(preset);
  const KeyFault cause =
      needs.empty() ? KeyFault{"accuracy", "model", -1, {}, "it is asked for"} : needs.front();
  const auto check = [&](const Rod& rod, const char* table) {
    if (rod.shear_GPa == 0)
      found.push_back({cause.table,
                       cause.key,
                       -1,
                       {fmt::format("[{}] shear_GPa", table)},
                       fmt::format("twists the rods ({}), and their torsional stiffness is not "
                                   "known: [{}] shear_GPa must be above 0",
                                   cause.what, table)});
  };
  check(preset.rod, "rod");
  if (preset.rod_v.differs) check(preset.rod_v, "rod_v");
  return found;
}

}  // namespace gridshell::preset
