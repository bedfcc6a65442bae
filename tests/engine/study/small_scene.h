// A shell small enough to try every method on in a second.
#pragma once

#include "engine/preset/preset.h"

namespace gridshell {

/// Four rods a direction; at 0.85 R_o.
inline preset::Preset small_scene() {
  preset::Preset preset;
  preset.name = "small";
  preset.footprint.rods = 4;
  preset.footprint.radius_mm = 20 * (1.5 + 0.8);
  preset.actuation.radius_mm = 0.85 * preset.footprint.radius_mm;
  return preset;
}

}  // namespace gridshell
