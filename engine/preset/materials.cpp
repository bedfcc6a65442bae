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

}  // namespace gridshell::preset
