#include "engine/scene/scene.h"

#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/try.h"
#include "engine/preset/consistency.h"
#include "engine/scene/drawn_footprint.h"
#include "engine/scene/net_design.h"
#include "engine/scene/rod_ends.h"
#include "engine/scene/rods_and_joints.h"

namespace gridshell {

namespace {

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

/// Frees the ends on the end rings of a surface of revolution, except those on its long edges.
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

/// Sets the prescribed directions of ends: from those in the flat to the net's tangents; without a
/// net they remain as drawn. `ends`: (u, v) of the edge points.
Result<void> set_end_directions(const Eigen::Matrix2Xd& ends, Scene& scene) {
  scene.motion.begin_tangent = scene.motion.end_tangent = Eigen::Matrix3Xd::Zero(3, ends.cols());
  for (Eigen::Index k = 0; k < ends.cols(); ++k) {
    const FootprintRod& rod = scene.footprint.rods[std::size_t(k / 2)];
    if (!fixes_direction(k % 2 == 0 ? rod.begin : rod.end)) continue;
    const Eigen::Vector3d tangent =
        rod.tangent_in_space(k % 2 == 0 ? rod.span.begin : rod.span.end);
    scene.motion.begin_tangent.col(k) =
        scene.flat.axes * tangent.head<2>() + tangent.z() * Eigen::Vector3d::UnitZ();
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
  // C maps the original boundary and the edge points to the actuated ones
  TRY(actuated, points_on(*scene.net, ring));
  TRY(ends_on_net, points_on(*scene.net, ends));
  scene.original_boundary = scene.flat.all(ring);
  scene.actuated_boundary = std::move(*actuated);
  scene.motion.begin = scene.flat.all(ends);
  scene.motion.end = std::move(*ends_on_net);
  if (preset.ends.rings == preset::Rings::free) free_rings(scene);
  return {};
}

/// Builds footprint, boundary and motion by the kind of the footprint.
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

}  // namespace

Eigen::RowVectorXd Scene::joint_masses() const {
  return Eigen::RowVectorXd::Constant(Eigen::Index(footprint.joints.size()), joint_mass_t);
}

int joint_at(const Footprint& footprint, int i, int j) {
  const auto found = std::ranges::find_if(
      footprint.joints, [&](const FootprintJoint& joint) { return joint.i == i && joint.j == j; });
  return found == footprint.joints.end() ? -1 : int(found - footprint.joints.begin());
}

Result<int> joint_named(const Footprint& footprint, const std::vector<int>& name) {
  if (name.size() == 2)
    if (const int joint = joint_at(footprint, name[0], name[1]); joint >= 0) return joint;
  const auto& joints = footprint.joints;
  const auto [i_least, i_most] = std::ranges::minmax_element(joints, {}, &FootprintJoint::i);
  const auto [j_least, j_most] = std::ranges::minmax_element(joints, {}, &FootprintJoint::j);
  return invalid(
      "joint: got [{}], expected [i, j] of one of the {} joints, i from {} to {} and j from {} to "
      "{}; joints.csv lists them",
      fmt::join(name, ", "), joints.size(), i_least->i, i_most->i, j_least->j, j_most->j);
}

/// Whether all joints resist spin of the rods' sections from the joint's normal.
bool joints_resist_spin(const Scene& scene) {
  const auto resists = [](const JointLaw& law) { return law.twist_Nmm > 0; };
  const auto& own = scene.rods.own_joints;
  return std::ranges::all_of(own, [&](const auto& at) { return resists(at.second); }) &&
         (resists(scene.rods.joints) || own.size() == scene.footprint.joints.size());
}

Result<Scene> scene_of(const preset::Preset& preset) {
  Scene scene;
  TRY_DO(build(preset, scene));
  if (preset.footprint.kind != preset::FootprintKind::network)
    for (FootprintRod& rod : scene.footprint.rods)
      for (RodEnd* end : {&rod.begin, &rod.end})
        if (*end == RodEnd::pinned) *end = rod_end_of(preset.ends.kind);
  if (std::ranges::any_of(scene.footprint.rods, [](const FootprintRod& rod) {
        return fixes_direction(rod.begin) || fixes_direction(rod.end);
      }))
    TRY_DO(set_end_directions(edge_points(scene.footprint), scene));
  if (preset.ends.second_ring_mm > 0) TRY_DO(add_second_ring(preset.ends.second_ring_mm, scene));
  TRY_DO(apply_ends_table(preset.ends.table, scene));
  TRY_DO(put_rods(preset, scene));
  scene.rod_model = preset::rod_model_of(preset);
  TRY_DO(put_laws(preset, scene));
  centre_edges(preset, scene);
  const bool round = std::ranges::count(scene.laths_mm, 0) == long(scene.laths_mm.size());
  if (round || !joints_resist_spin(scene)) scene.laths_mm.clear();
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
