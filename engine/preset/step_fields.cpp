#include "engine/preset/step_fields.h"

#include <fmt/format.h>

#include <map>

#include "engine/preset/field_makers.h"

namespace gridshell::preset {

std::vector<Field> step_fields() {
  using P = Preset;
  return {
      {"step", "do", "", word<&P::step, &Step::deed>(),
       "\"move\" the boundary; \"push\" a joint, which is held from then on; \"hold\" one where it "
       "is; \"release\" one; \"load\": more or less of what [loads] says; \"rest\": down the "
       "energy; \"jitter\": random forces on all joints come on and go away again"},
      {"step", "progress", "", real<&P::step, &Step::progress>(between(0, 10)),
       "of a move: 0 the original boundary, 1 the actuated one, beyond it further on"},
      {"step", "radius_mm", "mm", real<&P::step, &Step::radius_mm>(at_least(0)),
       "of a move of a circle, in the place of `progress`; 0: not given"},
      {"step", "edge_points", "",
       points<&P::step, &Step::edge_points>({"edge_point", "x_mm", "y_mm", "z_mm"}),
       "of a move: by how much edge points, counted from 0, lie off the boundary's motion; others "
       "lie on it"},
      {"step", "joint", "", integers<&P::step, &Step::joint>(between(-500, 500)),
       "[i, j] of the joint; of a release that names none: all that are held"},
      {"step", "to_mm", "mm", list<&P::step, &Step::to_mm>({}),
       "[x, y, z] to which a push brings the joint; empty: `depth_mm` says how far"},
      {"step", "depth_mm", "mm", real<&P::step, &Step::depth_mm>({}),
       "by how much a push moves the joint against the shell's normal, inward, from where it is; "
       "below 0 outward"},
      {"step", "along", "", list<&P::step, &Step::along>({}),
       "[x, y, z] of the direction in which a joint is held that may move across it; empty: the "
       "way of the push, of a hold all directions"},
      {"step", "lateral", "", word<&P::step, &Step::lateral>(),
       "whether the joint pushed may move across the push"},
      {"step", "factor", "", real<&P::step, &Step::factor>(between(-1000, 1000)),
       "how many times what [loads] says counts from then on; 0: not at all"},
      {"step", "side", "", word<&P::step, &Step::side>(),
       "of a rest from a state that is not stable: where the energy ends lower, or along or "
       "against its soft mode"},
      {"step", "seed", "", integer<&P::step, &Step::seed>(between(0, 1 << 30)),
       "of a jitter: another one shakes otherwise"},
      {"step", "force_N", "N", real<&P::step, &Step::force_N>(above(0)),
       "of a jitter: largest force on a joint along each axis"},
  };
}

std::vector<Deed> deeds_of_key(const std::string& key) {
  static const std::map<std::string, std::vector<Deed>> deeds{
      {"progress", {Deed::move}},
      {"radius_mm", {Deed::move}},
      {"edge_points", {Deed::move}},
      {"joint", {Deed::push, Deed::hold, Deed::release}},
      {"to_mm", {Deed::push}},
      {"depth_mm", {Deed::push}},
      {"along", {Deed::push, Deed::hold}},
      {"lateral", {Deed::push}},
      {"factor", {Deed::load}},
      {"side", {Deed::rest}},
      {"seed", {Deed::jitter}},
      {"force_N", {Deed::jitter}},
  };
  const auto found = deeds.find(key);
  return found == deeds.end() ? std::vector<Deed>{} : found->second;
}

namespace {

void check_step(const Preset& preset, int item, std::vector<Conflict>& found) {
  const Step& step = preset.step[std::size_t(item)];
  const auto wrong = [&](const char* key, std::string what) {
    found.push_back({"step", key, {}, std::move(what), item});
  };
  const bool names_joint = step.deed == Deed::push || step.deed == Deed::hold;
  if (step.joint.size() != 2 && (names_joint || !step.joint.empty()))
    wrong("joint", names_joint ? "must be [i, j]" : "must be [i, j], or empty for all");
  for (const auto& [key, list] : {std::pair("to_mm", &step.to_mm), {"along", &step.along}})
    if (!list->empty() && list->size() != 3)
      wrong(key, fmt::format("a list of {}, must be [x, y, z] or empty", list->size()));
  if (step.along.size() == 3 && step.along == std::vector<double>{0, 0, 0})
    wrong("along", "is no direction, must have a length");
  if (step.deed == Deed::push && step.to_mm.empty() == (step.depth_mm == 0))
    wrong("depth_mm", "a push goes to `to_mm` or by `depth_mm`, must be one of the two");
  if (step.deed == Deed::push && step.lateral == Lateral::held && !step.along.empty())
    wrong("along",
          "a joint that is held across the push has no direction of its own, must be "
          "empty, or lateral = \"free\"");
  if (step.radius_mm > 0 && preset.footprint.kind != FootprintKind::circle)
    wrong("radius_mm", "only a circle's boundary has a radius, must be 0: `progress` serves all");
  if (step.radius_mm > preset.original_radius_mm())
    wrong("radius_mm", fmt::format("larger than the footprint, must be at most R_o = {}",
                                   preset.original_radius_mm()));
  for (const auto& row : step.edge_points)
    if (row[0] < 0 || row[0] != double(int(row[0])))
      wrong("edge_points", "names an edge point that is no whole number from 0 on");
}

}  // namespace

std::vector<Conflict> step_conflicts(const Preset& preset) {
  std::vector<Conflict> found;
  if (preset.step.empty()) return found;
  for (int k = 0; k < int(preset.step.size()); ++k) check_step(preset, k, found);
  const auto alone = [&](std::vector<std::string> others, const char* what) {
    others.push_back("[[step]] 1 ");
    found.push_back({"step", "do", std::move(others), what, 0});
  };
  if (preset.indentation.wanted())
    alone({"[indentation] depth", "[indentation] depth_mm"},
          "[indentation] pushes already, must be a step \"push\" in its place");
  if (preset.jitter.wanted())
    alone({"[jitter] trials", "[jitter] confined"},
          "states are looked for of a shell that no hand touches, must be without [[step]], or "
          "[jitter] trials and confined 0");
  if (preset.accuracy.model == Rung::net)
    alone({"[accuracy] model"},
          "the rung \"net\" is geometry alone, must be another [accuracy] model");
  return found;
}

}  // namespace gridshell::preset
