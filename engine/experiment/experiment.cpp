#include "engine/experiment/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/experiment/actuation.h"

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

const char* reason_for_bend =
    "bend: the rods are round and naturally straight, their ends spin freely and the joints pass "
    "no "
    "twist, so the twist energy is zero at rest and leaving it out changes nothing; joints are "
    "shared nodes, the limit of stiff springs";

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

std::vector<double> samples_of(const preset::Preset& preset, bool stills) {
  std::vector<double> progress;
  if (stills && !preset.figure.radii_mm.empty()) {
    const double from = preset.footprint.radius_mm, to = preset.actuation.radius_mm;
    for (double radius : preset.figure.radii_mm) progress.push_back((from - radius) / (from - to));
    std::sort(progress.begin(), progress.end());
    return progress;
  }
  const int frames = preset.movie.frames;
  if (frames == 1) return {1.0};
  for (int k = 0; k < frames; ++k) progress.push_back(double(k) / (frames - 1));
  return progress;
}

record::Summary summary_of(const preset::Preset& preset, const ActuationScene& scene,
                           const ActuationOutcome& outcome) {
  const record::Frame& last = outcome.trajectory.frames.back();
  record::Summary s;
  s.preset = preset.name;
  s.model = "bend";
  s.model_reason = reason_for_bend;
  s.edges_per_segment = outcome.levels.edges_per_segment.back();
  s.rods = int(scene.footprint.rods.size());
  s.joints = int(scene.footprint.joints.size());
  s.cells = int(scene.footprint.cells.size());
  s.dof = outcome.dof;
  s.negative_pivots = last.negative_pivots;
  s.stable = last.negative_pivots == 0;
  s.limit = outcome.limit;
  s.limit_reason = outcome.limit_reason;
  s.residual_N = last.residual_N;
  s.error_estimate_mm = last.error_estimate_mm;
  s.energy_bend_mJ = last.energy_bend_mJ;
  s.energy_stretch_mJ = last.energy_stretch_mJ;
  s.energy_twist_mJ = last.energy_twist_mJ;
  s.height_mm = last.height_mm;
  s.total_K = last.total_K;
  s.newton_iterations = outcome.effort.newton_iterations;
  s.factorizations = outcome.effort.factorizations;
  s.seconds_setup = outcome.seconds_setup;
  s.seconds_simulation = outcome.seconds_simulation;
  return s;
}

}  // namespace

Result<Plan> plan(const preset::Preset& preset) {
  const auto scene = scene_of(preset);
  if (!scene) return tl::unexpected<Error>(scene.error());
  Plan plan;
  plan.model = "bend";
  plan.model_reason = reason_for_bend;
  plan.levels = scene->levels.edges_per_segment;
  plan.edges_per_segment = plan.levels.back();
  plan.extrapolated = scene->levels.extrapolate;
  plan.rods = int(scene->footprint.rods.size());
  plan.joints = int(scene->footprint.joints.size());
  plan.cells = int(scene->footprint.cells.size());
  const RodMesh mesh = mesh_rods(scene->footprint, plan.edges_per_segment);
  plan.dof = 3 * (mesh.nodes() - mesh.edge_points);
  plan.footprint = fmt::format(
      "{} rods, {} joints, {} cells; longest leg {:.2f} d, shortest {:.2f} d", plan.rods,
      plan.joints, plan.cells, scene->footprint.longest_leg() / scene->footprint.spacing,
      scene->footprint.shortest_leg() / scene->footprint.spacing);
  return plan;
}

Result<Outcome> run(const preset::Preset& preset, bool stills, Watch& watch) {
  const auto scene = scene_of(preset);
  if (!scene) return tl::unexpected<Error>(scene.error());
  auto outcome = run_actuation(*scene, samples_of(preset, stills), watch);
  if (!outcome) return tl::unexpected<Error>(outcome.error());
  if (outcome->trajectory.frames.empty())
    return fail(Fault::no_equilibrium, "no frame was certified: " + outcome->limit_reason);
  record::Summary summary = summary_of(preset, *scene, *outcome);
  return Outcome{std::move(outcome->trajectory), std::move(summary)};
}

}  // namespace gridshell::experiment
