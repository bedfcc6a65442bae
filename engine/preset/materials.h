// Materials of rods by name.
#pragma once

#include <functional>

#include "engine/preset/preset.h"

namespace gridshell::preset {

/// A Rod with young_GPa, shear_GPa, density_kg_m3 and strength_MPa of a material; its other members
/// have their defaults. Strengths are characteristic values in bending, without a safety factor; 0:
/// not known. Sources: presets/README.md, Materials.
Rod rod_of(Material material);

/// Keys of [rod] whose values depend on its material.
inline constexpr const char* keys_of_material[] = {"young_GPa", "shear_GPa", "density_kg_m3",
                                                   "strength_MPa", "yield_strain"};

/// Sets the values that `rod.material` gives; those of `given` remain where `is_set` is true for
/// the key, and all of them without a material. A material gives either strength_MPa or
/// yield_strain.
void take_material(Rod& rod, const Rod& given, const std::function<bool(const char* key)>& is_set);

}  // namespace gridshell::preset
