// What rods are made of, by name.
#pragma once

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// young_GPa, shear_GPa, density_kg_m3 and strength_MPa of a material, in a Rod that is otherwise
/// the default. A strength of 0 is not known. Strengths are characteristic values in bending,
/// without a safety factor. Sources: presets/README.md, Materials.
Rod rod_of(Material material);

}  // namespace gridshell::preset
