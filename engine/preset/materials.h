// Materials of rods by name.
#pragma once

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// A Rod with young_GPa, shear_GPa, density_kg_m3 and strength_MPa of a material; its other members
/// have their defaults. Strengths are characteristic values in bending, without a safety factor; 0:
/// not known. Sources: presets/README.md, Materials.
Rod rod_of(Material material);

}  // namespace gridshell::preset
