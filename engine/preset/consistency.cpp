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
  if (actuated > original)
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
  for (const double radius : preset.figure.radii_mm) {
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
  return found;
}

}  // namespace gridshell::preset
