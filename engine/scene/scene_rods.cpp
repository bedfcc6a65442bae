#include "engine/scene/scene_rods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gridshell {
namespace {

double area_of(const preset::Rod& rod) {
  return rod.rectangular() ? rod.width_mm * rod.thickness_mm
                           : M_PI * rod.diameter_mm * rod.diameter_mm / 4;
}

RodMaterial material_of(const preset::Rod& rod) {
  // the first director stands up: the thickness lies along it
  RodMaterial material =
      rod.rectangular()
          ? rectangular_material(rod.thickness_mm, rod.width_mm, rod.young_GPa, rod.shear_GPa)
          : circular_material(rod.diameter_mm, rod.young_GPa, rod.shear_GPa);
  // about the second, a tangent that turns downwards turns backwards
  material.curvature = {rod.curvature_sideways_per_mm, -rod.curvature_per_mm};
  material.twist = rod.twist_rad_per_mm;
  return material;
}

const preset::Rod& rod_of(const preset::Preset& preset, Family family) {
  if (family == Family::v && preset.rod_v.differs) return preset.rod_v;
  return preset.rod;
}

Result<std::vector<PointLoad>> points_of(const preset::Loads& loads, const Footprint& footprint) {
  std::vector<PointLoad> points;
  for (const auto& row : loads.points) {
    const int i = int(std::lround(row[0])), j = int(std::lround(row[1]));
    const int joint = row[0] == i && row[1] == j ? joint_at(footprint, i, j) : -1;
    if (joint < 0)
      return fail(
          Fault::bad_input,
          fmt::format("[loads] points: the footprint has no joint [{:g}, {:g}]", row[0], row[1]));
    points.push_back({joint, {row[2], row[3], row[4]}});
  }
  return points;
}

/// The diameters of `[rod] table`, of all rods.
Result<std::vector<double>> diameters_of(const preset::Preset& preset, const Footprint& footprint) {
  std::vector<double> diameters;
  for (const FootprintRod& one : footprint.rods)
    diameters.push_back(one.diameter_mm > 0 ? one.diameter_mm
                                            : rod_of(preset, one.family).diameter_mm);
  std::vector<bool> named(diameters.size(), false);
  for (const auto& row : preset.rod_table) {
    const Family family = row[0] == 0 ? Family::u : Family::v;
    const auto wrong = [&](const std::string& what) {
      return fail(Fault::bad_input, fmt::format("[rod] table: {}-rod {:g}: {}",
                                                row[0] == 0 ? "u" : "v", row[1], what));
    };
    if (rod_of(preset, family).rectangular()) return wrong("is rectangular, it has no diameter");
    if (!(row[2] > 0 && row[2] < preset.footprint.spacing_mm))
      return wrong(
          fmt::format("a diameter of {:g} mm, must be above 0 and less than "
                      "[footprint] spacing_mm = {:g}",
                      row[2], preset.footprint.spacing_mm));
    // of several rods on one line the first row is the first rod's
    std::size_t at = 0;
    while (at < footprint.rods.size() &&
           (named[at] || footprint.rods[at].family != family || footprint.rods[at].index != row[1]))
      ++at;
    if (at == footprint.rods.size())
      return wrong("the footprint has no such rod, or it is named more often than it is there");
    named[at] = true;
    diameters[at] = row[2];
  }
  return diameters;
}

}  // namespace

int joint_at(const Footprint& footprint, int i, int j) {
  for (std::size_t k = 0; k < footprint.joints.size(); ++k)
    if (footprint.joints[k].i == i && footprint.joints[k].j == j) return int(k);
  return -1;
}

Result<SceneRods> scene_rods(const preset::Preset& preset, const Footprint& footprint) {
  SceneRods rods;
  const preset::Loads& loads = preset.loads;
  auto diameters = diameters_of(preset, footprint);
  if (!diameters) return tl::unexpected<Error>(diameters.error());
  rods.diameters_mm = std::move(*diameters);
  for (std::size_t r = 0; r < footprint.rods.size(); ++r) {
    preset::Rod rod = rod_of(preset, footprint.rods[r].family);
    rod.diameter_mm = rods.diameters_mm[r];
    rods.drawn_diameters_mm.push_back(2 * std::sqrt(area_of(rod) / M_PI));
    const double mass = 1e-12 * rod.density_kg_m3 * area_of(rod);  // 1 kg/m^3 = 1e-12 t/mm^3
    rods.shell.materials.push_back(material_of(rod));
    rods.mass_t_per_mm.push_back(mass);
    if (loads.gravity_m_s2 != 0 || loads.field_N_per_mm != 0)
      rods.shell.weight_N_per_mm.push_back(1e3 * loads.gravity_m_s2 * mass + loads.field_N_per_mm);
  }
  auto points = points_of(loads, footprint);
  if (!points) return tl::unexpected<Error>(points.error());
  rods.shell.points = std::move(*points);
  const bool springs = preset.joints.kind == preset::JointKind::spring;
  rods.shell.joints = {springs ? preset.joints.stiffness_N_per_mm : 0, preset.joints.shear_Nmm,
                       preset.joints.twist_Nmm};
  rods.drawn_diameter_mm = 2 * std::sqrt(area_of(preset.rod) / M_PI);
  return rods;
}

}  // namespace gridshell
