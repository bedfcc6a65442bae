#include "engine/preset/materials.h"

namespace gridshell::preset {
namespace {

Rod made_of(double young_GPa, double shear_GPa, double density_kg_m3, double strength_MPa) {
  Rod rod;
  rod.young_GPa = young_GPa;
  rod.shear_GPa = shear_GPa;
  rod.density_kg_m3 = density_kg_m3;
  rod.strength_MPa = strength_MPa;
  return rod;
}

}  // namespace

Rod rod_of(Material material) {
  switch (material) {
    case Material::none:
      break;
    case Material::nitinol:
      return made_of(83, 31, 6450, 0);
    case Material::gfrp:
      return made_of(25, 3, 2000, 400);
    case Material::spruce:
      return made_of(11, 0.69, 420, 24);
    case Material::oak:
      return made_of(11, 0.69, 640, 30);
    case Material::steel:
      return made_of(210, 81, 7850, 235);
    case Material::aluminium:
      return made_of(70, 27, 2700, 250);
  }
  return {};
}

void take_material(Rod& rod, const Rod& given, const std::function<bool(const char* key)>& is_set) {
  const bool named = rod.material != Material::none;
  Rod made = named ? rod_of(rod.material) : given;
  if (named && is_set("yield_strain") && !is_set("strength_MPa")) made.strength_MPa = 0;
  if (is_set("strength_MPa")) made.yield_strain = given.yield_strain;
  for (const auto& [key, member] : {std::pair("young_GPa", &Rod::young_GPa),
                                    {"shear_GPa", &Rod::shear_GPa},
                                    {"density_kg_m3", &Rod::density_kg_m3},
                                    {"strength_MPa", &Rod::strength_MPa},
                                    {"yield_strain", &Rod::yield_strain}})
    rod.*member = is_set(key) ? given.*member : made.*member;
}

}  // namespace gridshell::preset
