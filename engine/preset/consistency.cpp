#include "engine/preset/consistency.h"

#include <fmt/format.h>

#include <tuple>

#include "engine/preset/rung.h"
#include "engine/preset/shape_consistency.h"

namespace gridshell::preset {
namespace {

constexpr const char* original_radius = "[footprint] radius_mm";
constexpr const char* actuated_radius = "[actuation] radius_mm";
constexpr const char* spacing = "[footprint] spacing_mm";

bool has_rings(const Preset& preset) {
  const NetKind kind = preset.net.kind;
  return preset.footprint.kind == FootprintKind::net && kind != NetKind::sphere &&
         kind != NetKind::translation && kind != NetKind::surface;
}

}  // namespace

std::vector<Conflict> conflicts(const Preset& preset) {
  std::vector<Conflict> found;
  const double original = preset.footprint.radius_mm, actuated = preset.actuation.radius_mm;
  const bool circle = preset.footprint.kind == FootprintKind::circle;
  const bool net = preset.on_net();
  if (circle && actuated > original)
    found.push_back({"actuation",
                     "radius_mm",
                     {original_radius},
                     fmt::format("larger than the footprint, must be at most {} = {}",
                                 original_radius, original)});
  if (preset.rod.diameter_mm >= preset.footprint.spacing_mm)
    found.push_back({"rod",
                     "diameter_mm",
                     {spacing},
                     fmt::format("neighbouring rods would touch, must be less than {} = {}",
                                 spacing, preset.footprint.spacing_mm)});
  double last = original;
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
  for (const double radius : circle ? preset.figure.radii_mm : std::vector<double>{}) {
    if (radius > last || radius < actuated) {
      found.push_back({"figure",
                       "radii_mm",
                       {original_radius, actuated_radius},
                       fmt::format("{} is not on the way, must fall from at most {} = {} to at "
                                   "least {} = {}",
                                   radius, original_radius, original, actuated_radius, actuated)});
      break;
    }
    last = radius;
  }
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
  for (const auto& [table, key, range] : {std::tuple("style", "range", &preset.style.range),
                                          {"movie", "bins_range", &preset.movie.bins_range}})
    if (!range->empty() && (range->size() != 2 || (*range)[0] >= (*range)[1]))
      found.push_back({table, key, {}, "must be [low, high] with low < high, or empty"});
  if (const auto count = preset.movie.target_mm.size(); count != 0 && count != 3)
    found.push_back(
        {"movie", "target_mm", {}, fmt::format("a list of {}, must be [x, y, z] or empty", count)});
  for (auto& more : {shape_conflicts(preset), block_conflicts(preset), end_conflicts(preset)})
    found.insert(found.end(), more.begin(), more.end());
  return found;
}

}  // namespace gridshell::preset
