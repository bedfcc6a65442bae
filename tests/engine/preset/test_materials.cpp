#include "engine/preset/materials.h"

#include "engine/preset/preset_file.h"
#include "engine/scene/scene.h"
#include "tests/results.h"

using namespace gridshell;
using Catch::Contains;

namespace {

preset::Preset read(const std::string& text, const std::vector<preset::Override>& more = {}) {
  return value_of(preset::read_preset_text(text, "own.toml", "own", more)).base;
}

/// The material of the first rod of a circle with these keys of [rod].
RodMaterial made(const std::string& rod) {
  return value_of(scene_of(read("[rod]\n" + rod))).rods.materials.front();
}

}  // namespace

TEST_CASE("a material gives what is not given, and says so in the preset that is kept") {
  const preset::Preset gfrp = read("[rod]\nmaterial = \"gfrp\"\n");
  CHECK(gfrp.rod.young_GPa == 25);
  CHECK(gfrp.rod.strength_MPa == 400);
  // other keys of the same file count more than the material, whatever their order
  const preset::Preset own =
      read("[rod]\nyoung_GPa = 40\nmaterial = \"gfrp\"\ndensity_kg_m3 = 1900\n");
  CHECK(own.rod.young_GPa == 40);
  CHECK(own.rod.density_kg_m3 == 1900);
  CHECK(own.rod.shear_GPa == 3);
  CHECK(read(preset::to_toml(own)).rod == own.rod);
  // a material given by --set counts more than the keys of the file
  const preset::Preset over = read(preset::to_toml(own), {{"--set", "rod.material", "\"spruce\""}});
  CHECK(over.rod.young_GPa == 11);
  CHECK(over.rod.density_kg_m3 == 420);
  const preset::Preset yields = read("[rod]\nmaterial = \"steel\"\nyield_strain = 0.002\n");
  CHECK(yields.rod.strength_MPa == 0);
  CHECK(yields.rod.fibre_strength_MPa() == Approx(420));
}

TEST_CASE("the material none gives back the values of the file, or the defaults") {
  const preset::Override none{"--set", "rod.material", "none"};
  const std::string steel = "[rod]\nmaterial = \"steel\"\n";
  CHECK(read(steel, {none}).rod == preset::Rod());
  CHECK(read(steel + "young_GPa = 90\n", {none}).rod.young_GPa == 90);
  // the value of the file counts again, although a case replaced it
  const auto cases = value_of(preset::read_preset_text(
      "[rod]\nyoung_GPa = 90\nyield_strain = 0.01\n[[case]]\nname = \"a\"\nrod.material = "
      "\"steel\"\n[[case]]\nname = \"b\"\n",
      "own.toml", "own"));
  CHECK(cases.cases[0].preset.rod.young_GPa == 210);
  CHECK(cases.cases[0].preset.rod.yield_strain == 0);
  CHECK(cases.cases[1].preset.rod.young_GPa == 90);
  const std::string second = "[rod_v]\ndiffers = true\nmaterial = \"steel\"\n";
  const preset::Preset v = read(second, {{"--set", "rod_v.material", "none"}});
  CHECK(static_cast<const preset::Rod&>(v.rod_v) == preset::Rod());
}

TEST_CASE("tubes have the stiffness of their wall") {
  const RodMaterial tube = made("diameter_mm = 10\nwall_mm = 2\nyoung_GPa = 25\nshear_GPa = 3\n");
  const double I = M_PI / 64 * (std::pow(10, 4) - std::pow(6, 4)), A = M_PI / 4 * (100 - 36);
  CHECK(tube.EA == Approx(25e3 * A));
  CHECK(tube.EI1 == Approx(25e3 * I));
  CHECK(tube.EI2 == tube.EI1);
  CHECK(tube.GJ == Approx(3e3 * 2 * I));
  CHECK(tube.fibres.about_1 == 5);
  CHECK(tube.fibres.area_mm2 == Approx(A));
  const RodMaterial box =
      made("width_mm = 8\nthickness_mm = 6\nwall_mm = 1\nyoung_GPa = 25\nshear_GPa = 3\n");
  CHECK(box.EA == Approx(25e3 * (48 - 24)));
  // upright: the thickness lies along the first director
  CHECK(std::min(box.EI1, box.EI2) == Approx(25e3 * (8 * 216 - 6 * 64) / 12));
  CHECK(std::max(box.EI1, box.EI2) == Approx(25e3 * (6 * 512 - 4 * 216) / 12));
  CHECK(box.GJ == Approx(3e3 * 4 * 35 * 35 * 1 / 24));
  CHECK_THAT(refusal(preset::read_preset_text("[rod]\nwall_mm = 0.127\n", "a", "a")),
             Contains("(a tube with such a wall is not hollow), expected below 0.127"));
}

TEST_CASE("stiffnesses, mass and section modulus may be given freely") {
  const std::string free =
      "diameter_mm = 10\nyoung_GPa = 10\nEA_N = 2e5\nEI_Nmm2 = 3e6\nGJ_Nmm2 = 4e5\n"
      "mass_g_per_m = 150\nmodulus_mm3 = 60\nstrength_MPa = 100\n";
  const RodMaterial rod = made(free);
  CHECK(rod.EA == 2e5);
  CHECK(rod.EI1 == 3e6);
  CHECK(rod.GJ == 4e5);
  CHECK(rod.fibres.area_mm2 == Approx(20));
  // E c kappa = M/W, with M = EI kappa
  CHECK(1e4 * rod.fibres.strain(0.01) == Approx(3e6 * 0.01 / 60));
  CHECK(value_of(scene_of(read("[rod]\n" + free))).mass_t_per_mm.front() == Approx(150e-9));
  CHECK_THAT(refusal(preset::read_preset_text(
                 "[rod]\nwidth_mm = 2\nthickness_mm = 1\nEI_Nmm2 = 3\n", "a", "a")),
             Contains("not equal in all directions"));
}
