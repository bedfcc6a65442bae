// A circle of six rods, small enough to be formed in a moment.
#pragma once

#include "engine/preset/preset.h"

namespace gridshell {

inline preset::Preset small_shell() {
  preset::Preset preset;
  preset.name = preset.title = "small";
  preset.footprint.rods = 6;
  preset.footprint.radius_mm = 66;
  preset.actuation.radius_mm = 54;
  preset.imperfection.size = 0;
  preset.movie.frames = 2;
  return preset;
}

}  // namespace gridshell
