#include "engine/preset/consistency.h"

#include <fmt/format.h>

#include <tuple>

#include "engine/preset/rung.h"
#include "engine/preset/shape_consistency.h"
#include "engine/preset/step_fields.h"

namespace gridshell::preset {
namespace {

constexpr const char* spacing = "[footprint] spacing_mm";
constexpr int least_leader = 4;

/// Whether a net ends in two rings.
bool has_rings(const Preset& preset) {
  if (preset.footprint.kind != FootprintKind::net) return false;
  switch (preset.net.kind) {
    case NetKind::sphere:
    case NetKind::translation:
    case NetKind::surface:
      return false;
    case NetKind::cylinder:
    case NetKind::spool:
    case NetKind::beltrami:
    case NetKind::profile:
      break;
  }
  return true;
}

/// Of a circle: from R_o to R_a its boundary shrinks, through the radii of its stills.
void check_radii(const Preset& preset, std::vector<Conflict>& found) {
  const double original = preset.original_radius_mm(), actuated = preset.actuated_radius_mm();
  const bool by_leg = preset.footprint.longest_leg > 0, by_ratio = preset.actuation.ratio > 0;
  const char* from = by_leg ? "[footprint] longest_leg" : "[footprint] radius_mm";
  const char* to = by_ratio ? "[actuation] ratio" : "[actuation] radius_mm";
  const auto is = [](bool indirect, const char* key, const char* name, double radius) {
    return indirect ? fmt::format("{} = {} by {}", name, radius, key)
                    : fmt::format("{} = {}", key, radius);
  };
  const auto original_is = is(by_leg, from, "R_o", original);
  if (actuated > original)
    found.push_back({"actuation",
                     "radius_mm",
                     {from},
                     fmt::format("larger than the footprint, must be at most {}", original_is)});
  double last = original;
  for (const double radius : preset.figure.radii_mm) {
    if (radius > last || radius < actuated) {
      found.push_back({"figure",
                       "radii_mm",
                       {from, to},
                       fmt::format("{} is not on the way, must fall from at most {} to at least {}",
                                   radius, original_is, is(by_ratio, to, "R_a", actuated))});
      break;
    }
    last = radius;
  }
}

}  // namespace

std::vector<Conflict> conflicts(const Preset& preset) {
  std::vector<Conflict> found;
  const bool circle = preset.footprint.kind == FootprintKind::circle;
  const bool net = preset.on_net();
  if (circle) check_radii(preset, found);
  if (preset.footprint.kind != FootprintKind::network &&
      preset.rod.diameter_mm >= preset.footprint.spacing_mm)
    found.push_back({"rod",
                     "diameter_mm",
                     {spacing},
                     fmt::format("neighbouring rods would touch, must be less than {} = {}",
                                 spacing, preset.footprint.spacing_mm)});
  if (!net && preset.actuation.start == Start::net)
    found.push_back({"actuation",
                     "start",
                     {"[footprint] kind"},
                     circle ? "a circle has no net to start from, must be \"flat\", or [footprint] "
                              "kind = \"net\""
                            : "a curve has no net to start from, must be \"flat\", or [footprint] "
                              "kind = \"net\""});
  if (!has_rings(preset) && preset.ends.rings == Rings::free)
    found.push_back({"ends",
                     "rings",
                     {"[footprint] kind", "[net] kind"},
                     "only a surface of revolution has end rings, must be \"pinned\""});
  if (!circle && !preset.figure.radii_mm.empty())
    found.push_back({"figure",
                     "radii_mm",
                     {"[footprint] kind"},
                     "only a circle's boundary has a radius all the way, must be empty for "
                     "any other [footprint] kind"});
  if (preset.jitter.wanted() && preset.indentation.wanted())
    found.push_back(
        {"jitter",
         "trials",
         {"[indentation] depth", "[indentation] depth_mm", "[jitter] confined"},
         "states are looked for of a shell that nothing pushes, must be 0, or the depth "
         "of [indentation]"});
  for (auto& conflict : physics_conflicts(preset)) found.push_back(std::move(conflict));
  if (const auto count = preset.indentation.joint.size(); count != 0 && count != 2)
    found.push_back(
        {"indentation", "joint", {}, fmt::format("a list of {}, must be [i, j] or empty", count)});
  if (const int leader = preset.accuracy.leading_edges; leader > 0) {
    if (leader < least_leader)
      found.push_back({"accuracy",
                       "leading_edges",
                       {},
                       fmt::format("{} edges know bifurcations that the shell does not have, must "
                                   "be 0 or at least {}",
                                   leader, least_leader)});
    if (preset.accuracy.edges_per_segment > 0)
      found.push_back({"accuracy",
                       "leading_edges",
                       {"[accuracy] edges_per_segment"},
                       "the mesh asked for says which one leads, must be 0"});
  }
  for (const auto& [table, key, range] : {std::tuple("style", "range", &preset.style.range),
                                          {"movie", "bins_range", &preset.movie.bins_range}})
    if (!range->empty() && (range->size() != 2 || (*range)[0] >= (*range)[1]))
      found.push_back({table, key, {}, "must be [low, high] with low < high, or empty"});
  if (preset.movie.colour_by == ColourBy::deviation && !net)
    found.push_back({"movie",
                     "colour_by",
                     {"[footprint] kind"},
                     "\"deviation\" is from the net that a footprint was designed on, must be "
                     "another, or [footprint] kind = \"net\" or \"blocks\""});
  if (const auto count = preset.movie.target_mm.size(); count != 0 && count != 3)
    found.push_back(
        {"movie", "target_mm", {}, fmt::format("a list of {}, must be [x, y, z] or empty", count)});
  for (auto& more : {shape_conflicts(preset), block_conflicts(preset), end_conflicts(preset),
                     step_conflicts(preset)})
    found.insert(found.end(), more.begin(), more.end());
  return found;
}

}  // namespace gridshell::preset
