#include "engine/experiment/scene.h"

#include <utility>

namespace gridshell::experiment {
namespace {

constexpr int boundary_points = 256;

Eigen::Matrix3Xd lifted(const Eigen::Matrix2Xd& ring) {
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, ring.cols());
  points.topRows(2) = ring;
  return points;
}

LevelPlan levels_of(const preset::Accuracy& accuracy) {
  const int fixed = accuracy.edges_per_segment;
  if (fixed == 0) return plan_levels(accuracy.tolerance);
  // a mesh that is asked for is the last of those that nest in it; alone, its error is not known
  LevelPlan plan{{fixed}, false};
  for (int k = fixed; k % 2 == 0 && k / 2 >= 4; k /= 2)
    plan.edges_per_segment.insert(plan.edges_per_segment.begin(), k / 2);
  return plan;
}

}  // namespace

Result<ActuationScene> scene_of(const preset::Preset& preset) {
  ActuationScene scene;
  const auto placement =
      preset.footprint.placement == preset::Placement::half ? Placement::half : Placement::on_axis;
  auto footprint = circular_footprint(preset.footprint.radius_mm, preset.footprint.rods,
                                      preset.footprint.spacing_mm, placement);
  if (!footprint) return tl::unexpected<Error>(footprint.error());
  scene.footprint = std::move(*footprint);
  scene.section = circular_section(preset.rod.diameter_mm, preset.rod.young_GPa);
  scene.rod_diameter_mm = preset.rod.diameter_mm;
  scene.radius_begin_mm = scene.length_scale_mm = preset.footprint.radius_mm;
  scene.radius_end_mm = preset.actuation.radius_mm;
  const double ratio = scene.radius_end_mm / scene.radius_begin_mm;
  scene.original_boundary = lifted(Disk(scene.radius_begin_mm).boundary(boundary_points));
  scene.actuated_boundary = ratio * scene.original_boundary;

  const int rods = int(scene.footprint.rods.size());
  scene.motion.begin = Eigen::Matrix3Xd::Zero(3, 2 * rods);
  for (int r = 0; r < rods; ++r) {
    const FootprintRod& rod = scene.footprint.rods[r];
    const auto point = [&](double along) -> Eigen::Vector3d {
      return rod.family == Family::u ? Eigen::Vector3d(along, rod.line, 0)
                                     : Eigen::Vector3d(rod.line, along, 0);
    };
    scene.motion.begin.col(2 * r) = point(rod.span.begin);
    scene.motion.begin.col(2 * r + 1) = point(rod.span.end);
  }
  scene.motion.end = ratio * scene.motion.begin;
  scene.seed.up = preset.actuation.seed == preset::Seed::up ? 1 : -1;
  scene.seed.diagonal = preset.actuation.seed_diagonal == preset::SeedDiagonal::y_eq_x ? 1 : -1;
  scene.levels = levels_of(preset.accuracy);
  scene.levels_fixed = preset.accuracy.edges_per_segment > 0;
  scene.tolerance = preset.accuracy.tolerance;
  scene.max_strain = preset.limits.max_strain;
  return scene;
}

}  // namespace gridshell::experiment
