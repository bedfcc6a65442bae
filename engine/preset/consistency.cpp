#include "engine/preset/consistency.h"

#include <fmt/format.h>

namespace gridshell::preset {
namespace {

constexpr const char* original_radius = "[footprint] radius_mm";
constexpr const char* actuated_radius = "[actuation] radius_mm";
constexpr const char* spacing = "[footprint] spacing_mm";

}  // namespace

std::vector<Conflict> conflicts(const Preset& preset) {
  std::vector<Conflict> found;
  const double original = preset.footprint.radius_mm, actuated = preset.actuation.radius_mm;
  const bool circle = preset.footprint.kind == FootprintKind::circle;
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
  if (circle && preset.actuation.start == Start::net)
    found.push_back({"actuation",
                     "start",
                     {"[footprint] kind"},
                     "a circle has no net to start from, must be \"flat\", or [footprint] kind = "
                     "\"net\""});
  if (circle && preset.ends.kind == EndKind::tangent)
    found.push_back({"ends",
                     "kind",
                     {"[footprint] kind"},
                     "a circle has no net whose tangents could be held, must be \"pinned\""});
  if ((circle || preset.net.kind == NetKind::sphere) && preset.ends.rings == Rings::free)
    found.push_back({"ends",
                     "rings",
                     {"[footprint] kind", "[net] kind"},
                     "only a surface of revolution has end rings, must be \"pinned\""});
  if (!circle && !preset.figure.radii_mm.empty())
    found.push_back({"figure",
                     "radii_mm",
                     {"[footprint] kind"},
                     "only a circle's boundary has a radius all the way, must be empty for "
                     "[footprint] kind = \"net\""});
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
  if (const auto count = preset.indentation.joint.size(); count != 0 && count != 2)
    found.push_back({"indentation",
                     "joint",
                     {},
                     fmt::format("a list of {}, must be [i, j] or empty", count)});
  return found;
}

}  // namespace gridshell::preset
