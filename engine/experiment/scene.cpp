#include "engine/experiment/scene.h"

#include <utility>

#include "engine/experiment/net_design.h"

namespace gridshell::experiment {
namespace {

constexpr int boundary_points = 256;

LevelPlan levels_of(const preset::Accuracy& accuracy) {
  const int fixed = accuracy.edges_per_segment;
  if (fixed == 0) return plan_levels(accuracy.tolerance);
  // a mesh that is asked for is the last of those that nest in it; alone, its error is not known
  LevelPlan plan{{fixed}, false};
  for (int k = fixed; k % 2 == 0 && k / 2 >= 4; k /= 2)
    plan.edges_per_segment.insert(plan.edges_per_segment.begin(), k / 2);
  return plan;
}

Placement placement_of(const preset::Preset& preset) {
  return preset.footprint.placement == preset::Placement::half ? Placement::half
                                                               : Placement::on_axis;
}

/// (u, v) of the edge points: begin and end of rod r at columns 2r and 2r + 1.
Eigen::Matrix2Xd edge_points(const Footprint& footprint) {
  Eigen::Matrix2Xd points(2, 2 * footprint.rods.size());
  for (Eigen::Index r = 0; r < Eigen::Index(footprint.rods.size()); ++r) {
    const FootprintRod& rod = footprint.rods[r];
    const auto point = [&](double along) {
      return rod.family == Family::u ? Eigen::Vector2d(along, rod.line)
                                     : Eigen::Vector2d(rod.line, along);
    };
    points.col(2 * r) = point(rod.span.begin);
    points.col(2 * r + 1) = point(rod.span.end);
  }
  return points;
}

Result<void> build_circle(const preset::Preset& preset, ActuationScene& scene) {
  auto footprint = circular_footprint(preset.footprint.radius_mm, preset.footprint.rods,
                                      preset.footprint.spacing_mm, placement_of(preset));
  if (!footprint) return tl::unexpected<Error>(footprint.error());
  scene.footprint = std::move(*footprint);
  scene.radius_begin_mm = scene.length_scale_mm = preset.footprint.radius_mm;
  scene.radius_end_mm = preset.actuation.radius_mm;
  const double ratio = scene.radius_end_mm / scene.radius_begin_mm;
  scene.original_boundary = scene.flat.all(Disk(scene.radius_begin_mm).boundary(boundary_points));
  scene.actuated_boundary = ratio * scene.original_boundary;
  scene.motion.begin = scene.flat.all(edge_points(scene.footprint));
  scene.motion.end = ratio * scene.motion.begin;
  return {};
}

Result<void> build_net(const preset::Preset& preset, ActuationScene& scene) {
  auto design = net_design(preset.net);
  if (!design) return tl::unexpected<Error>(design.error());
  auto footprint =
      cut_footprint(*design->domain, preset.footprint.spacing_mm, placement_of(preset));
  if (!footprint) return tl::unexpected<Error>(footprint.error());
  scene.footprint = std::move(*footprint);
  scene.net = design->net;
  scene.flat = design->flat;
  scene.from_net = preset.actuation.start == preset::Start::net;
  scene.length_scale_mm = design->scale_mm;
  // C maps the original boundary to the actuated one, the edge points too
  const Eigen::Matrix2Xd ring = design->domain->boundary(boundary_points);
  const Eigen::Matrix2Xd ends = edge_points(scene.footprint);
  const auto actuated = sample(*scene.net, ring), held = sample(*scene.net, ends);
  for (const auto* sampled : {&actuated, &held})
    if (!*sampled) return tl::unexpected<Error>(sampled->error());
  scene.original_boundary = scene.flat.all(ring);
  scene.actuated_boundary = *actuated;
  scene.motion.begin = scene.flat.all(ends);
  scene.motion.end = *held;
  return {};
}

}  // namespace

Result<ActuationScene> scene_of(const preset::Preset& preset) {
  ActuationScene scene;
  const bool net = preset.footprint.kind == preset::FootprintKind::net;
  if (const auto built = net ? build_net(preset, scene) : build_circle(preset, scene); !built)
    return tl::unexpected<Error>(built.error());
  scene.section = circular_section(preset.rod.diameter_mm, preset.rod.young_GPa);
  scene.rod_diameter_mm = preset.rod.diameter_mm;
  scene.seed.up = preset.actuation.seed == preset::Seed::up ? 1 : -1;
  scene.seed.diagonal = preset.actuation.seed_diagonal == preset::SeedDiagonal::y_eq_x ? 1 : -1;
  scene.levels = levels_of(preset.accuracy);
  scene.levels_fixed = preset.accuracy.edges_per_segment > 0;
  scene.tolerance = preset.accuracy.tolerance;
  scene.max_strain = preset.limits.max_strain;
  return scene;
}

}  // namespace gridshell::experiment
