#include "engine/preset/model_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace gridshell::preset {
namespace {

constexpr double net_tolerance = 0.05;

/// table and values of every kind of rod there is
std::vector<std::pair<std::string, const Rod*>> kinds_of(const Preset& preset) {
  if (preset.rod_v.differs) return {{"rod", &preset.rod}, {"rod_v", &preset.rod_v}};
  return {{"rod", &preset.rod}};
}

std::string key_of(const Requirement& demand) {
  return fmt::format("[{}] {}", demand.table, demand.key);
}

std::string list_of(const std::vector<Requirement>& demands) {
  std::vector<std::string> all;
  for (const auto& demand : demands)
    if (std::find(all.begin(), all.end(), demand.what) == all.end()) all.push_back(demand.what);
  return fmt::format("{}", fmt::join(all, ", and "));
}

void add_rods_beyond_bend(const Preset& preset, std::vector<Requirement>& found) {
  const bool clamped = preset.ends.kind == EndKind::clamped;
  for (const auto& [table, rod] : kinds_of(preset)) {
    const bool two_axes = rod->rectangular() && rod->width_mm != rod->thickness_mm;
    const bool curved = rod->curvature_per_mm != 0 || rod->curvature_sideways_per_mm != 0;
    if (two_axes)
      found.push_back(
          {table, "width_mm", "rods that are not alike in all directions spin as they bend"});
    if (rod->curvature_per_mm != 0)
      found.push_back({table, "curvature_per_mm", "rods curved at rest spin to keep their curve"});
    if (rod->curvature_sideways_per_mm != 0)
      found.push_back(
          {table, "curvature_sideways_per_mm", "rods curved at rest spin to keep their curve"});
    // a round straight rod whose ends spin freely untwists by itself
    if (rod->twist_rad_per_mm != 0 && (two_axes || curved || clamped))
      found.push_back({table, "twist_rad_per_mm", "rods twisted at rest turn their axes"});
  }
}

}  // namespace

std::vector<Requirement> twist_requirements(const Preset& preset) {
  std::vector<Requirement> found;
  if (preset.ends.kind == EndKind::clamped)
    found.push_back({"ends", "kind", "clamped ends hold the rods' spin"});
  add_rods_beyond_bend(preset, found);
  if (preset.joints.kind == JointKind::spring)
    found.push_back({"joints", "kind", "spring joints give each rod a node of its own"});
  if (preset.joints.shear_Nmm > 0)
    found.push_back({"joints", "shear_Nmm", "the joints resist shear"});
  if (preset.joints.twist_Nmm > 0)
    found.push_back({"joints", "twist_Nmm", "the joints pass twist"});
  return found;
}

std::vector<Requirement> equilibrium_requirements(const Preset& preset) {
  std::vector<Requirement> found;
  if (!preset.on_net())
    found.push_back({"footprint", "kind", "a footprint that was not designed on a net has none"});
  if (preset.accuracy.tolerance < net_tolerance)
    found.push_back({"accuracy", "tolerance",
                     fmt::format("a net is a few hundredths of its radius off, the tolerance must "
                                 "be {} or more",
                                 net_tolerance)});
  if (preset.indentation.wanted())
    found.push_back({"indentation", "depth", "a net does not answer a push"});
  if (!preset.step.empty()) found.push_back({"step", "do", "a net does not answer a hand"});
  if (preset.loads.any()) found.push_back({"loads", "points", "a net does not answer loads"});
  if (preset.ends.second_ring_mm > 0)
    found.push_back({"ends", "second_ring_mm", "a net has no tails"});
  if (!preset.ends.table.empty())
    found.push_back({"ends", "table", "a net's ends lie where the net has them"});
  if (preset.accuracy.edges_per_segment > 0)
    found.push_back({"accuracy", "edges_per_segment", "a mesh is asked for"});
  if (preset.accuracy.leading_edges > 0)
    found.push_back({"accuracy", "leading_edges", "a mesh is asked for"});
  if (preset.movie.colour_by == ColourBy::energy || preset.movie.colour_by == ColourBy::axial_force)
    found.push_back({"movie", "colour_by", "a net's rods bear no forces"});
  return found;
}

RodModel rod_model_of(const Preset& preset) {
  if (preset.accuracy.model != RodModel::automatic) return preset.accuracy.model;
  const bool twist = !twist_requirements(preset).empty();
  const bool cap = preset.footprint.kind == FootprintKind::net &&
                   preset.net.kind == NetKind::sphere && preset.ends.kind == EndKind::pinned;
  if (!twist && cap && equilibrium_requirements(preset).empty()) return RodModel::net;
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
      const auto demands = twist_requirements(preset);
      return demands.empty()
                 ? "twist, as asked: every rod's torsion is in it; `bend` would give the same "
                   "shape, "
                   "as nothing twists these rods"
                 : fmt::format("twist: {}; nothing is left out, the torsion of every rod is in it",
                               list_of(demands));
    }
    case RodModel::automatic:  // the rung is a choice made
    case RodModel::bend:
      break;
  }
  return "bend: the rods are round and naturally straight, their ends spin freely and the "
         "joints pass no twist, so the twist energy is zero at rest and leaving it out changes "
         "nothing; joints are shared nodes, the limit of stiff springs";
}

namespace {

void add_rung_conflicts(const Preset& preset, std::vector<Conflict>& found) {
  const auto refuse = [&](const Requirement& demand) {
    found.push_back({"accuracy",
                     "model",
                     {key_of(demand)},
                     fmt::format("cannot serve {}: {}", key_of(demand), demand.what)});
  };
  if (preset.accuracy.model == RodModel::bend)
    for (const Requirement& demand : twist_requirements(preset)) refuse(demand);
  if (preset.accuracy.model == RodModel::net) {
    for (const Requirement& demand : equilibrium_requirements(preset)) refuse(demand);
    for (const Requirement& demand : twist_requirements(preset)) refuse(demand);
  }
  if (rod_model_of(preset) != RodModel::twist) return;
  const auto demands = twist_requirements(preset);
  const Requirement cause =
      demands.empty() ? Requirement{"accuracy", "model", "it is asked for"} : demands.front();
  for (const auto& [table, rod] : kinds_of(preset))
    if (rod->shear_GPa == 0)
      found.push_back({cause.table,
                       cause.key,
                       {fmt::format("[{}] shear_GPa", table)},
                       fmt::format("twists the rods ({}), and their torsional stiffness is not "
                                   "known: [{}] shear_GPa must be above 0",
                                   cause.what, table)});
}

void add_rod_conflicts(const Preset& preset, std::vector<Conflict>& found) {
  if (!preset.rod_v.differs && static_cast<const Rod&>(preset.rod_v) != Rod())
    found.push_back({"rod_v",
                     "differs",
                     {},
                     "the other keys of [rod_v] would count for nothing, must be true"});
  for (const auto& [table, rod] : kinds_of(preset))
    if ((rod->width_mm > 0) != (rod->thickness_mm > 0))
      found.push_back({table,
                       rod->width_mm > 0 ? "width_mm" : "thickness_mm",
                       {},
                       fmt::format("a rectangular section has both, [{}] {} must be above 0 too",
                                   table, rod->width_mm > 0 ? "thickness_mm" : "width_mm")});
  for (const auto& [table, rod] : kinds_of(preset))
    if (preset.dynamics.snap && rod->density_kg_m3 == 0)
      found.push_back(
          {"dynamics",
           "snap",
           {fmt::format("[{}] density_kg_m3", table)},
           fmt::format("motion needs a mass, [{}] density_kg_m3 must be above 0", table)});
  for (const auto& [table, rod] : kinds_of(preset))
    if (preset.loads.gravity_m_s2 != 0 && rod->density_kg_m3 == 0)
      found.push_back(
          {"loads",
           "gravity_m_s2",
           {fmt::format("[{}] density_kg_m3", table)},
           fmt::format("gravity needs a mass, [{}] density_kg_m3 must be above 0", table)});
}

void add_joint_conflicts(const Preset& preset, std::vector<Conflict>& found) {
  const bool springs = preset.joints.kind == JointKind::spring;
  if (springs && preset.joints.stiffness_N_per_mm == 0)
    found.push_back({"joints",
                     "kind",
                     {"[joints] stiffness_N_per_mm"},
                     "springs without stiffness hold nothing, [joints] stiffness_N_per_mm must be "
                     "above 0"});
  if (!springs && preset.joints.stiffness_N_per_mm > 0)
    found.push_back({"joints",
                     "stiffness_N_per_mm",
                     {"[joints] kind"},
                     "shared joints have no stiffness, must be 0, or [joints] kind = \"spring\""});
}

}  // namespace

std::vector<Conflict> physics_conflicts(const Preset& preset) {
  std::vector<Conflict> found;
  add_rod_conflicts(preset, found);
  add_joint_conflicts(preset, found);
  add_rung_conflicts(preset, found);
  return found;
}

}  // namespace gridshell::preset
