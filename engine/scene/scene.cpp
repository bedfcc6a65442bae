// From a preset's rods, joints and loads to those of the models.

#include "engine/scene/scene.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/core/try.h"
#include "engine/preset/consistency.h"
#include "engine/scene/drawn_footprint.h"
#include "engine/scene/net_design.h"
#include "engine/scene/rod_ends.h"

namespace gridshell {

namespace {

/// The diameter of a round rod as thick as a rod is drawn.
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
  // about the second, a tangent that turns downwards turns backwards
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

/// The rod of a table or, of a network, of its file.
preset::Rod rod_of(const preset::Preset& preset, const FootprintRod& drawn) {
  if (drawn.number >= 0) return preset::rod_of_network(preset, drawn.number, drawn.reversed);
  return drawn.family == Family::v && preset.rod_v.differs ? preset.rod_v : preset.rod;
}

/// All rods, with the diameters of `[rod] table`.
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
    // of several rods on one line the first row belongs to the first rod
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
  return rods;
}

/// Gives a scene's footprint the preset's rods, joints and loads. Errors (bad_input): a load on a
/// joint, a diameter of a rod that is not there.
Result<void> put_rods(const preset::Preset& preset, Scene& scene) {
  const Footprint& footprint = scene.footprint;
  const preset::Loads& loads = preset.loads;
  TRY(rods, rods_of(preset, footprint));
  for (const preset::Rod& rod : *rods) {
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
        {preset.contact.gap_mm, preset.contact.stiffness_N_per_mm}, {}, preset.joints.diameter_mm};
    for (const double diameter : scene.drawn_diameters_mm)
      scene.rods.contact.radius_mm.push_back(0.5 * diameter);
  }
  scene.rod_diameter_mm = drawn_diameter_of(preset.rod);
  return {};
}

constexpr int boundary_points = 256;

/// (u, v) of the edge points: begin and end of rod r at columns 2r and 2r + 1.
Eigen::Matrix2Xd edge_points(const Footprint& footprint) {
  Eigen::Matrix2Xd points(2, 2 * footprint.rods.size());
  for (Eigen::Index r = 0; r < Eigen::Index(footprint.rods.size()); ++r) {
    const FootprintRod& rod = footprint.rods[r];
    points.col(2 * r) = rod.at(rod.span.begin);
    points.col(2 * r + 1) = rod.at(rod.span.end);
  }
  return points;
}

Result<void> build_circle(const preset::Preset& preset, Scene& scene) {
  TRY(footprint, circular_footprint(preset.original_radius_mm(), preset.footprint.rods,
                                    preset.footprint.spacing_mm, preset.footprint.placement));
  scene.footprint = std::move(*footprint);
  scene.radius_begin_mm = scene.length_scale_mm = preset.original_radius_mm();
  scene.radius_end_mm = preset.actuated_radius_mm();
  const double ratio = scene.radius_end_mm / scene.radius_begin_mm;
  scene.original_boundary = scene.flat.all(Disk(scene.radius_begin_mm).boundary(boundary_points));
  scene.actuated_boundary = ratio * scene.original_boundary;
  scene.motion.begin = scene.flat.all(edge_points(scene.footprint));
  scene.motion.end = ratio * scene.motion.begin;
  return {};
}

Result<void> clip(const Domain& domain, const preset::Preset& preset, Scene& scene) {
  TRY(footprint, cut_footprint(domain, preset.footprint.spacing_mm, preset.footprint.placement));
  scene.footprint = std::move(*footprint);
  return {};
}

Result<void> build_curve(const preset::Preset& preset, Scene& scene) {
  TRY(design, curve_design(preset));
  TRY_DO(clip(*design->domain, preset, scene));
  scene.length_scale_mm = design->scale_mm;
  const Eigen::Matrix2Xd ring = design->domain->boundary(boundary_points);
  const Eigen::Matrix2Xd ends = edge_points(scene.footprint);
  scene.original_boundary = scene.flat.all(ring);
  scene.actuated_boundary = scene.flat.all(design->actuated(ring));
  scene.motion.begin = scene.flat.all(ends);
  scene.motion.end = scene.flat.all(design->actuated(ends));
  return {};
}

/// Lets go of the ends on the end rings of a surface of revolution, but for those on its long
/// edges.
void free_rings(Scene& scene) {
  const double ring = scene.actuated_boundary.row(0).cwiseAbs().maxCoeff();
  const double near = 1e-9 * scene.length_scale_mm;
  for (std::size_t r = 0; r < scene.footprint.rods.size(); ++r) {
    const auto on_ring = [&](Eigen::Index end) {
      const Eigen::Vector3d at = scene.motion.end.col(end);
      return std::abs(at.x()) > ring - near && at.z() > near;
    };
    FootprintRod& rod = scene.footprint.rods[r];
    if (on_ring(2 * Eigen::Index(r))) rod.begin = RodEnd::free;
    if (on_ring(2 * Eigen::Index(r) + 1)) rod.end = RodEnd::free;
  }
}

/// Motion of ends with prescribed directions: from the flat state to the net's tangents, or without
/// a net as they are drawn.
Result<void> hold_directions(const Eigen::Matrix2Xd& ends, Scene& scene) {
  scene.motion.begin_tangent = scene.motion.end_tangent = Eigen::Matrix3Xd::Zero(3, ends.cols());
  for (Eigen::Index k = 0; k < ends.cols(); ++k) {
    const FootprintRod& rod = scene.footprint.rods[std::size_t(k / 2)];
    if (!holds_direction(k % 2 == 0 ? rod.begin : rod.end)) continue;
    const Eigen::Vector3d way = rod.way(k % 2 == 0 ? rod.span.begin : rod.span.end);
    scene.motion.begin_tangent.col(k) =
        scene.flat.axes * way.head<2>() + way.z() * Eigen::Vector3d::UnitZ();
    scene.motion.end_tangent.col(k) = scene.motion.begin_tangent.col(k);
    if (!scene.net) continue;
    TRY(point, scene.net->at(ends(0, k), ends(1, k)));
    scene.motion.end_tangent.col(k) = rod.family == Family::u ? point->tangent_u : point->tangent_v;
  }
  return {};
}

Result<void> build_net(const preset::Preset& preset, Scene& scene) {
  TRY(design, preset.footprint.kind == preset::FootprintKind::blocks
                  ? block_design(preset)
                  : net_design(preset.net, preset.footprint.spacing_mm));
  TRY_DO(clip(*design->domain, preset, scene));
  scene.net = design->net;
  scene.blocks = design->blocks;
  scene.mesh_net = design->report;
  scene.flat = design->flat;
  scene.from_net = preset.actuation.start == preset::Start::net;
  scene.length_scale_mm = design->scale_mm;
  const Eigen::Matrix2Xd ring = design->domain->boundary(boundary_points);
  const Eigen::Matrix2Xd ends = edge_points(scene.footprint);
  // C maps the original boundary to the actuated one, the edge points too
  TRY(actuated, points_on(*scene.net, ring));
  TRY(held, points_on(*scene.net, ends));
  scene.original_boundary = scene.flat.all(ring);
  scene.actuated_boundary = std::move(*actuated);
  scene.motion.begin = scene.flat.all(ends);
  scene.motion.end = std::move(*held);
  if (preset.ends.rings == preset::Rings::free) free_rings(scene);
  return {};
}

/// Footprint, boundary and motion, as the kind has them.
Result<void> build(const preset::Preset& preset, Scene& scene) {
  switch (preset.footprint.kind) {
    case preset::FootprintKind::circle:
      return build_circle(preset, scene);
    case preset::FootprintKind::curve:
      return build_curve(preset, scene);
    case preset::FootprintKind::network:
      return build_network(preset, scene);
    case preset::FootprintKind::net:
    case preset::FootprintKind::blocks:
      break;
  }
  return build_net(preset, scene);
}

/// How a rod runs through a joint as drawn.
Eigen::Vector3d way_through(const FootprintRod& rod, int joint) {
  const auto at = std::ranges::find(rod.joints, joint) - rod.joints.begin();
  const double mark = rod.marks[std::size_t(at)], near = 1e-6 * (rod.span.end - rod.span.begin);
  return rod.way(std::max(mark - near, rod.span.begin)) +
         rod.way(std::min(mark + near, rod.span.end));
}

/// Checks that rods connected at a joint cross there, and that an eccentricity joins two rods, from
/// the one listed first in the file.
Result<void> check_crossings(Scene& scene) {
  Footprint& footprint = scene.footprint;
  std::vector<std::vector<const FootprintRod*>> rods(footprint.joints.size());
  for (const FootprintRod& rod : footprint.rods)
    for (const int joint : std::set<int>(rod.joints.begin(), rod.joints.end()))
      rods[std::size_t(joint)].push_back(&rod);
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
        const Eigen::Vector3d t = way_through(*a, joint).normalized(),
                              s = way_through(*b, joint).normalized();
        if (a < b && t.cross(s).norm() < 1e-3)
          return invalid(
              "joint [{}, {}]: rods[{}] and rods[{}] have equal directions there, expected rods "
              "that cross, as the joint has a law of the angle between them",
              here.i, here.j, a->number, b->number);
      }
  }
  return {};
}

/// Gives every rod an edge centred on joints that connect rods by a law, now or after a step adds
/// bolts.
void centre_edges(const preset::Preset& preset, Scene& scene) {
  const bool bolted = std::ranges::any_of(preset.step, [](const preset::Step& step) {
    return step.kind == preset::StepKind::tighten || step.kind == preset::StepKind::open;
  });
  std::vector<int> rods(scene.footprint.joints.size(), 0);
  for (const FootprintRod& rod : scene.footprint.rods)
    for (const int joint : std::set<int>(rod.joints.begin(), rod.joints.end()))
      ++rods[std::size_t(joint)];
  for (std::size_t joint = 0; joint < rods.size(); ++joint) {
    FootprintJoint& here = scene.footprint.joints[joint];
    const JointLaw& law = scene.rods.law(int(joint));
    const bool held =
        scene.rod_model == RodModel::twist && (law.shear_Nmm > 0 || law.twist_Nmm > 0);
    here.centred = rods[joint] > 1 && (bolted || held || here.eccentricity != 0);
  }
}

/// Sets the natural shapes of a network's rods, and the joints with laws of their own.
Result<void> put_laws(const preset::Preset& preset, Scene& scene) {
  const auto stiffness = [](double given) {
    return given < 0 ? std::numeric_limits<double>::infinity() : given;
  };
  for (FootprintJoint& joint : scene.footprint.joints)
    joint.eccentricity = preset.joints.eccentricity_mm;
  if (preset.footprint.kind != preset::FootprintKind::network) return {};
  for (std::size_t r = 0; scene.drawn_in_space && r < scene.rods.materials.size(); ++r)
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

}  // namespace

Eigen::RowVectorXd Scene::joint_masses() const {
  return Eigen::RowVectorXd::Constant(Eigen::Index(footprint.joints.size()), joint_mass_t);
}

int joint_at(const Footprint& footprint, int i, int j) {
  const auto found = std::ranges::find_if(
      footprint.joints, [&](const FootprintJoint& joint) { return joint.i == i && joint.j == j; });
  return found == footprint.joints.end() ? -1 : int(found - footprint.joints.begin());
}

/// Whether all joints keep rods' sections to their normal.
bool holds_sections(const Scene& scene) {
  const auto holds = [](const JointLaw& law) { return law.twist_Nmm > 0; };
  const auto& own = scene.rods.own_joints;
  return std::ranges::all_of(own, [&](const auto& at) { return holds(at.second); }) &&
         (holds(scene.rods.joints) || own.size() == scene.footprint.joints.size());
}

Result<Scene> scene_of(const preset::Preset& preset) {
  Scene scene;
  TRY_DO(build(preset, scene));
  if (preset.footprint.kind != preset::FootprintKind::network)
    for (FootprintRod& rod : scene.footprint.rods)
      for (RodEnd* end : {&rod.begin, &rod.end})
        if (*end == RodEnd::pinned) *end = hold_as(preset.ends.kind);
  if (std::ranges::any_of(scene.footprint.rods, [](const FootprintRod& rod) {
        return holds_direction(rod.begin) || holds_direction(rod.end);
      }))
    TRY_DO(hold_directions(edge_points(scene.footprint), scene));
  if (preset.ends.second_ring_mm > 0) TRY_DO(add_second_ring(preset.ends.second_ring_mm, scene));
  TRY_DO(apply_ends_table(preset.ends.table, scene));
  TRY_DO(put_rods(preset, scene));
  scene.rod_model = preset::rod_model_of(preset);
  TRY_DO(put_laws(preset, scene));
  centre_edges(preset, scene);
  const bool round = std::ranges::count(scene.laths_mm, 0) == long(scene.laths_mm.size());
  if (round || !holds_sections(scene)) scene.laths_mm.clear();
  scene.seed.up = preset.actuation.seed == preset::Seed::up ? 1 : -1;
  scene.seed.diagonal = preset.actuation.seed_diagonal == preset::SeedDiagonal::y_eq_x ? 1 : -1;
  scene.imperfection = {preset.imperfection.size * scene.footprint.spacing,
                        preset.imperfection.seed,
                        preset.imperfection.form == preset::ImperfectionForm::soft_mode};
  scene.load_imperfection_mm = preset.loads.imperfection * scene.length_scale_mm;
  scene.edges_per_segment = preset.accuracy.edges_per_segment;
  scene.tolerance = preset.accuracy.tolerance;
  scene.memory_GB = preset.accuracy.memory_GB;
  scene.max_strain = preset.limits.max_strain;
  scene.max_bending_strain = preset.limits.max_bending_strain;
  scene.max_utilisation = preset.limits.max_utilisation;
  scene.joint_diameter_mm = preset.joints.diameter_mm;
  scene.joint_height_mm = preset.joints.height_mm;
  scene.stops_at_contact = preset.limits.contact == preset::OnContact::stop;
  scene.table = preset.limits.table;
  scene.snap = {preset.dynamics.snap, preset.dynamics.step_s, preset.dynamics.damping_per_s};
  return scene;
}

Result<std::vector<Eigen::Matrix3Xd>> rods_on_net(const Scene& scene, double step_mm) {
  std::vector<Eigen::Matrix3Xd> lines;
  if (!scene.net) return lines;
  for (const FootprintRod& rod : scene.footprint.rods) {
    const double length = rod.span.end - rod.span.begin;
    const int steps = std::max(1, int(std::ceil(length / step_mm)));
    Eigen::Matrix2Xd uv(2, steps + 1);
    for (int k = 0; k <= steps; ++k) uv.col(k) = rod.at(rod.span.begin + length * k / steps);
    TRY(line, points_on(*scene.net, uv));
    lines.push_back(std::move(*line));
  }
  return lines;
}

Result<std::shared_ptr<const Scene>> shared_scene_of(const preset::Preset& preset) {
  return scene_of(preset).map(
      [](Scene&& scene) { return std::make_shared<const Scene>(std::move(scene)); });
}

}  // namespace gridshell
