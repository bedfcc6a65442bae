#include "engine/scene/rods_and_joints.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "engine/core/try.h"
#include "engine/preset/consistency.h"

namespace gridshell {
namespace {

/// Diameter with which a rod is drawn: a rectangular one as a round rod of equal area.
double drawn_diameter_of(const preset::Rod& rod) {
  return rod.rectangular() ? 2 * std::sqrt(rod.width_mm * rod.thickness_mm / M_PI)
                           : rod.diameter_mm;
}

RodMaterial section_of(const preset::Rod& rod) {
  const double E = rod.young_GPa, G = rod.shear_GPa;
  // the first director is vertical: the thickness is along it
  if (rod.rectangular())
    return rod.wall_mm > 0 ? box_material(rod.thickness_mm, rod.width_mm, rod.wall_mm, E, G)
                           : rectangular_material(rod.thickness_mm, rod.width_mm, E, G);
  return rod.wall_mm > 0 ? tube_material(rod.diameter_mm, rod.wall_mm, E, G)
                         : circular_material(rod.diameter_mm, E, G);
}

/// Stiffnesses of the section, or the given ones that replace them. A free section has the area
/// EA/E and the fibre distance EI/(E W).
RodMaterial material_of(const preset::Rod& rod) {
  RodMaterial material = section_of(rod);
  const double young_MPa = 1e3 * rod.young_GPa;
  if (rod.EI_Nmm2 > 0) material.EI1 = material.EI2 = rod.EI_Nmm2;
  if (rod.GJ_Nmm2 > 0) material.GJ = rod.GJ_Nmm2;
  if (rod.EA_N > 0) {
    material.EA = rod.EA_N;
    material.fibres.area_mm2 = rod.EA_N / young_MPa;
  }
  if (rod.modulus_mm3 > 0) {
    if (material.fibres.area_mm2 == 0) material.fibres.area_mm2 = material.EA / young_MPa;
    material.fibres.about_1 = material.fibres.about_2 =
        material.EI1 / (young_MPa * rod.modulus_mm3);
  }
  // the sign: a tangent that turns downwards turns backwards about the second director
  material.curvature = {rod.curvature_sideways_per_mm, -rod.curvature_per_mm};
  material.twist = rod.twist_rad_per_mm;
  material.as_drawn = rod.as_drawn;
  return material;
}

double mass_t_per_mm(const preset::Rod& rod, const RodMaterial& material) {
  if (rod.mass_g_per_m > 0) return 1e-9 * rod.mass_g_per_m;
  const double area = material.EA / (1e3 * rod.young_GPa);
  return 1e-12 * rod.density_kg_m3 * area;  // 1 kg/m^3 = 1e-12 t/mm^3
}

/// The properties of a rod: those of [rod] or [rod_v], or those in the file of a network.
preset::Rod rod_of(const preset::Preset& preset, const FootprintRod& drawn) {
  if (drawn.number >= 0) return preset::rod_of_network(preset, drawn.number, drawn.reversed);
  return drawn.family == Family::v && preset.rod_v.differs ? preset.rod_v : preset.rod;
}

/// Tangent of a rod at a joint as drawn, not normalised: the mean of both sides at a corner.
Eigen::Vector3d tangent_through(const FootprintRod& rod, int joint) {
  const auto at = std::ranges::find(rod.joints, joint) - rod.joints.begin();
  const double mark = rod.marks[std::size_t(at)], near = 1e-6 * (rod.span.end - rod.span.begin);
  return rod.tangent_in_space(std::max(mark - near, rod.span.begin)) +
         rod.tangent_in_space(std::min(mark + near, rod.span.end));
}

/// The rods at each joint; a rod that is there twice counts once.
std::vector<std::vector<const FootprintRod*>> rods_at_joints(const Footprint& footprint) {
  std::vector<std::vector<const FootprintRod*>> rods(footprint.joints.size());
  for (const FootprintRod& rod : footprint.rods)
    for (const int joint : std::set<int>(rod.joints.begin(), rod.joints.end()))
      rods[std::size_t(joint)].push_back(&rod);
  return rods;
}

/// Checks that rods connected by a law at a joint cross there, and that an eccentricity is between
/// two rods; its sign counts from the rod that is first in the file.
Result<void> check_crossings(Scene& scene) {
  Footprint& footprint = scene.footprint;
  const auto rods = rods_at_joints(footprint);
  for (int joint = 0; joint < int(rods.size()); ++joint) {
    const JointLaw& law = scene.rods.law(joint);
    FootprintJoint& here = footprint.joints[std::size_t(joint)];
    if (law.shear_Nmm == 0 && law.twist_Nmm == 0 && here.eccentricity == 0) continue;
    if (here.eccentricity != 0 && rods[std::size_t(joint)].size() > 2)
      return invalid("joint [{}, {}]: {} rods cross there, expected two for an eccentricity",
                     here.i, here.j, rods[std::size_t(joint)].size());
    if (rods[std::size_t(joint)].front()->number > rods[std::size_t(joint)].back()->number)
      here.eccentricity *= -1;
    for (const FootprintRod* a : rods[std::size_t(joint)])
      for (const FootprintRod* b : rods[std::size_t(joint)]) {
        const Eigen::Vector3d t = tangent_through(*a, joint).normalized(),
                              s = tangent_through(*b, joint).normalized();
        if (a < b && t.cross(s).norm() < 1e-3)
          return invalid(
              "joint [{}, {}]: rods[{}] and rods[{}] have equal directions there, expected rods "
              "that cross, as the joint has a law of the angle between them; two ends in one line "
              "are drawn as one rod",
              here.i, here.j, a->number, b->number);
      }
  }
  return {};
}

}  // namespace

Result<std::vector<preset::Rod>> rods_of(const preset::Preset& preset, const Footprint& footprint) {
  std::vector<preset::Rod> rods;
  for (const FootprintRod& one : footprint.rods) rods.push_back(rod_of(preset, one));
  std::vector<bool> named(rods.size(), false);
  for (const auto& row : preset.rod_table) {
    const Family family = row[0] == 0 ? Family::u : Family::v;
    const auto wrong = [&](const std::string& what) {
      return invalid("[rod] table: {}-rod {:g}: {}", row[0] == 0 ? "u" : "v", row[1], what);
    };
    if (!(row[2] > 0 && row[2] < preset.footprint.spacing_mm))
      return wrong(fmt::format(
          "got a diameter of {:g} mm, expected above 0 and less than [footprint] spacing_mm = {:g}",
          row[2], preset.footprint.spacing_mm));
    // if there are several rods on one line, the first row belongs to the first rod
    std::size_t at = 0;
    while (at < rods.size() &&
           (named[at] || footprint.rods[at].family != family || footprint.rods[at].index != row[1]))
      ++at;
    if (at == rods.size())
      return wrong("got no such rod, or more rows than the footprint has of it");
    if (rods[at].rectangular()) return wrong("got a diameter of a rectangular rod, expected none");
    named[at] = true;
    rods[at].diameter_mm = row[2];
  }
  // a rod with a diameter of its own has the wall of all
  for (std::size_t r = 0; r < rods.size(); ++r) {
    const FootprintRod& drawn = footprint.rods[r];
    if (rods[r].wall_fits()) continue;
    const std::string name =
        drawn.number >= 0
            ? fmt::format("rods[{}]", drawn.number)
            : fmt::format("{}-rod {}", drawn.family == Family::u ? "u" : "v", drawn.index);
    return invalid(
        "[rod] wall_mm: got {:g} mm for {} of {:g} mm diameter, which is then not hollow, expected "
        "below {:g}",
        rods[r].wall_mm, name, rods[r].diameter_mm, 0.5 * rods[r].thinnest_mm());
  }
  return rods;
}

/// Whether a rod is drawn bent: its chord is shorter than the rod by a tenth of the shortening at
/// which paths from the flat begin, or more. A ring is bent anyway, and in equilibrium as a circle.
bool drawn_bent(const FootprintRod& rod) {
  constexpr double least_shortening = 1e-4;
  if (rod.path.empty() || rod.closed()) return false;
  const double chord = (rod.on_path(rod.span.end) - rod.on_path(rod.span.begin)).norm();
  return chord < (1 - least_shortening) * (rod.span.end - rod.span.begin);
}

bool starts_from_drawing(const Scene& scene) {
  const std::vector<FootprintRod>& rods = scene.footprint.rods;
  if (scene.footprint.in_space()) return true;
  for (std::size_t r = 0; r < rods.size(); ++r)
    if (rods[r].number >= 0 && !scene.rods.materials[r].as_drawn && drawn_bent(rods[r]))
      return true;
  return false;
}

Result<void> put_rods(const preset::Preset& preset, Scene& scene) {
  const Footprint& footprint = scene.footprint;
  const preset::Loads& loads = preset.loads;
  TRY(rods, rods_of(preset, footprint));
  double deepest_mm = 0;
  for (const preset::Rod& rod : *rods) {
    deepest_mm = std::max(deepest_mm, rod.thinnest_mm());
    scene.diameters_mm.push_back(rod.diameter_mm);
    scene.drawn_diameters_mm.push_back(drawn_diameter_of(rod));
    const bool lath = rod.rectangular();
    scene.laths_mm.insert(scene.laths_mm.end(),
                          {lath ? rod.width_mm : 0, lath ? rod.thickness_mm : 0});
    const RodMaterial material = material_of(rod);
    const double mass = mass_t_per_mm(rod, material);
    scene.rods.materials.push_back(material);
    scene.mass_t_per_mm.push_back(mass);
    scene.strength_MPa.push_back(rod.fibre_strength_MPa());
    if (loads.gravity_m_s2 != 0 || loads.field_N_per_mm != 0)
      scene.rods.weight_N_per_mm.push_back(1e3 * loads.gravity_m_s2 * mass + loads.field_N_per_mm);
  }
  scene.from_drawing = starts_from_drawing(scene);
  // the paper's joints are for rods of 0.254 mm; thicker rods need larger ones
  scene.joint_diameter_mm = preset.joints.diameter_mm.value_or(std::max(3.0, 1.5 * deepest_mm));
  scene.joint_height_mm = preset.joints.height_mm.value_or(std::max(5.0, 1.5 * deepest_mm));
  scene.joint_mass_t = 1e-6 * preset.joints.mass_g;
  scene.rods.joint_weight_N = 1e3 * loads.gravity_m_s2 * scene.joint_mass_t;
  if (std::ranges::count(scene.strength_MPa, 0) > 0) scene.strength_MPa.clear();
  TRY(points, points_of(loads.points, "[loads]", footprint));
  scene.rods.points = std::move(*points);
  TRY(cases, load_cases_of(preset, footprint));
  scene.load_cases = std::move(*cases);
  const bool springs = preset.joints.kind == preset::JointKind::spring;
  scene.rods.joints = {springs ? preset.joints.stiffness_N_per_mm : 0, preset.joints.shear_Nmm,
                       preset.joints.twist_Nmm};
  if (preset.contact.model == preset::ContactModel::barrier) {
    scene.rods.contact = {
        {preset.contact.gap_mm, preset.contact.stiffness_N_per_mm}, {}, scene.joint_diameter_mm};
    for (const double diameter : scene.drawn_diameters_mm)
      scene.rods.contact.radius_mm.push_back(0.5 * diameter);
  }
  scene.rod_diameter_mm = drawn_diameter_of(preset.rod);
  return {};
}

Result<void> put_laws(const preset::Preset& preset, Scene& scene) {
  const auto stiffness = [](double given) {
    return given < 0 ? std::numeric_limits<double>::infinity() : given;
  };
  for (FootprintJoint& joint : scene.footprint.joints)
    joint.eccentricity = preset.joints.eccentricity_mm;
  if (preset.footprint.kind != preset::FootprintKind::network) return {};
  for (std::size_t r = 0; scene.footprint.in_space() && r < scene.rods.materials.size(); ++r)
    if (scene.rods.materials[r].as_drawn && scene.footprint.rods[r].closed())
      return invalid(
          "[rod] as_drawn: rods[{}] is a ring drawn in space, whose section is rotated after one "
          "turn, expected a rod with two ends",
          scene.footprint.rods[r].number);
  for (const auto& row : preset.footprint.file.joint_laws) {
    if (row[0] == preset::every_joint) {
      scene.rods.joints.shear_Nmm = stiffness(row[1]);
      scene.rods.joints.twist_Nmm = stiffness(row[2]);
      continue;
    }
    const int joint = joint_at(scene.footprint, int(row[0]), 0);
    if (joint < 0)
      return invalid(
          "[footprint] file: joints: got point {:g}, where no rods are joined, expected a joint",
          row[0]);
    scene.rods.own_joints[joint] = {scene.rods.joints.spring_N_per_mm, stiffness(row[1]),
                                    stiffness(row[2])};
    if (row.size() < 4) continue;
    if (row[3] != 0 && scene.rods.joints.spring_N_per_mm > 0)
      return invalid(
          "[footprint] file: joints: the axes at point {:g} have a distance and are connected by a "
          "bolt, expected [joints] kind = \"shared\"",
          row[0]);
    scene.footprint.joints[std::size_t(joint)].eccentricity = row[3];
  }
  return scene.footprint.rods.front().number < 0 ? Result<void>() : check_crossings(scene);
}

void centre_edges(const preset::Preset& preset, Scene& scene) {
  const bool bolted = std::ranges::any_of(preset.step, [](const preset::Step& step) {
    return step.kind == preset::StepKind::tighten || step.kind == preset::StepKind::open;
  });
  const auto rods = rods_at_joints(scene.footprint);
  for (std::size_t joint = 0; joint < rods.size(); ++joint) {
    FootprintJoint& here = scene.footprint.joints[joint];
    const JointLaw& law = scene.rods.law(int(joint));
    const bool connected =
        scene.rod_model == RodModel::twist && (law.shear_Nmm > 0 || law.twist_Nmm > 0);
    here.centred = rods[joint].size() > 1 && (bolted || connected || here.eccentricity != 0);
  }
}

}  // namespace gridshell
