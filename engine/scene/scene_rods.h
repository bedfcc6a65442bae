// From a preset's rods, joints and loads to those of the models.
#pragma once

#include "engine/core/result.h"
#include "engine/footprint/footprint.h"
#include "engine/gridshell/shell_rods.h"
#include "engine/preset/preset.h"

namespace gridshell {

/// The rods of a footprint as a preset wants them.
struct SceneRods {
  ShellRods shell;
  std::vector<double> mass_t_per_mm;       ///< one a rod; 0 where no density is given
  std::vector<double> diameters_mm;        ///< one a rod, of round ones
  double drawn_diameter_mm = 0;            ///< of a round section of the area of [rod]'s
  std::vector<double> drawn_diameters_mm;  ///< of every rod's
};

/// Errors (bad_input): a load on a joint that the footprint does not have; a diameter of a rod that
/// it does not have, of none or a rectangular one, or as wide as the rods' spacing.
Result<SceneRods> scene_rods(const preset::Preset& preset, const Footprint& footprint);

/// The joint (i, j), or -1.
int joint_at(const Footprint& footprint, int i, int j);

}  // namespace gridshell
