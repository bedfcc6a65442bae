// A rod whose frequencies and natural shapes are known.
#pragma once

#include "tests/presets.h"

namespace gridshell {

/// A straight round rod of 1 mm along x, clamped at its start, free at its end, with a joint in its
/// middle: E = 80 GPa, G = 30 GPa.
inline preset::Preset round_cantilever(double length_mm) {
  preset::NetworkData file;
  file.points = {{0, 0, 0}, {length_mm / 2, 0, 0}, {length_mm, 0, 0}};
  file.rods = {{0, 1, 2}};
  file.free = {2};
  file.end_constraints = {{0, 0, double(preset::EndKind::clamped)}};
  preset::Preset p = network(file);
  p.rod.diameter_mm = 1;
  p.rod.young_GPa = 80;
  p.rod.shear_GPa = 30;
  return p;
}

}  // namespace gridshell
