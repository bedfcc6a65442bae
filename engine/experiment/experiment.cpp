#include "engine/experiment/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/experiment/actuation.h"
#include "engine/experiment/indentation.h"
#include "engine/experiment/net_sample.h"
#include "engine/experiment/scene.h"
#include "engine/experiment/twist_actuation.h"
#include "engine/measure/deviation.h"
#include "engine/preset/rung.h"

namespace gridshell::experiment {
namespace {

std::vector<double> samples_of(const preset::Preset& preset, bool stills) {
  std::vector<double> progress;
  // only a circle's boundary has a radius all the way
  if (stills && preset.footprint.kind != preset::FootprintKind::circle) return {1.0};
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

/// Of a push: all frames of a movie, or enough for the curve of its force.
std::vector<double> even_samples(const preset::Preset& preset, bool stills) {
  const int frames = stills ? 11 : std::max(2, preset.movie.frames);
  std::vector<double> progress;
  for (int k = 0; k < frames; ++k) progress.push_back(double(k) / (frames - 1));
  return progress;
}

record::Summary summary_of(const preset::Preset& preset, const ActuationScene& scene,
                           const ActuationOutcome& outcome) {
  const record::Frame& last = outcome.trajectory.frames.back();
  record::Summary s;
  s.preset = preset.name;
  s.model = preset::name_of(preset::rung_of(preset));
  s.model_reason = preset::model_reason(preset);
  s.solved = preset::rung_of(preset) != preset::Model::net;
  s.edges_per_segment = outcome.levels.edges_per_segment.back();
  s.rods = int(scene.footprint.rods.size());
  s.joints = int(scene.footprint.joints.size());
  s.cells = int(scene.footprint.cells.size());
  s.dof = outcome.dof;
  s.negative_pivots = std::max(last.negative_pivots, 0);
  s.stable = last.negative_pivots == 0;
  s.limit = outcome.limit;
  s.limit_reason = outcome.limit_reason;
  s.residual_N = last.residual_N;
  s.error_estimate_mm = last.error_estimate_mm;
  s.energies = last.energies;
  s.height_mm = last.height_mm;
  s.total_K = last.total_K;
  const record::Layout& layout = outcome.trajectory.layout;
  if (layout.net_nodes.size() > 0) {
    // joints are the first nodes
    const Eigen::Index joints = s.joints;
    const Deviation deviation(last.nodes.leftCols(joints), layout.net_nodes.leftCols(joints),
                              layout.length_scale_mm);
    s.max_deviation = deviation.largest();
    s.mean_deviation = deviation.mean();
    s.median_deviation = deviation.quantile(0.5);
    s.deviation_p90 = deviation.quantile(0.9);
  }
  if (scene.blocks && !scene.blocks->seams().empty()) {
    s.max_seam_gap_mm = s.max_seam_kink_deg = 0;
    for (const Seam& seam : scene.blocks->seams()) {
      s.max_seam_gap_mm = std::max(s.max_seam_gap_mm, seam.max_gap_mm());
      s.max_seam_kink_deg = std::max(s.max_seam_kink_deg, seam.max_kink_deg());
    }
  }
  s.newton_iterations = outcome.effort.newton_iterations;
  s.factorizations = outcome.effort.factorizations;
  s.seconds_setup = outcome.seconds_setup;
  s.seconds_simulation = outcome.seconds_simulation;
  return s;
}

int dof_of(const ActuationScene& scene, preset::Model rung, int edges_per_segment) {
  if (rung == preset::Model::net) return 0;
  const RodMesh mesh = mesh_rods(scene.footprint, edges_per_segment);
  if (rung == preset::Model::bend) return build_model(mesh, scene.rods).dof();
  const auto model = twist_model_of(mesh, scene.twist);
  return model ? model->dof() : 0;
}

/// About how long a run takes on one core: bringing the coarsest mesh to rest, then two corrections
/// a frame on each mesh. Measured on shells of 500 to 40 000 unknowns; good within a factor of
/// three.
double seconds_for(const ActuationScene& scene, preset::Model rung, const preset::Preset& preset) {
  constexpr double to_rest = 1.5e-5, a_frame = 4e-7, a_twist_frame = 1e-5;  // seconds an unknown
  if (rung == preset::Model::net) return 0.01;
  const bool twist = rung == preset::Model::twist;
  double seconds = 0;
  for (int edges : scene.levels.edges_per_segment) {
    const double dof = dof_of(scene, rung, edges);
    if (seconds == 0) seconds = to_rest * dof;
    seconds += (twist ? a_twist_frame : a_frame) * dof * preset.movie.frames;
  }
  return seconds;
}

Result<ActuationOutcome> actuate(const ActuationScene& scene, preset::Model rung,
                                 const std::vector<double>& progress, Watch& watch) {
  switch (rung) {
    case preset::Model::net:
      return sample_net(scene, progress, watch);
    case preset::Model::twist:
      return run_twist_actuation(scene, progress, watch);
    default:
      return run_actuation(scene, progress, watch);
  }
}

}  // namespace

Result<Plan> plan(const preset::Preset& preset) {
  const auto scene = scene_of(preset);
  if (!scene) return tl::unexpected<Error>(scene.error());
  Plan plan;
  const preset::Model rung = preset::rung_of(preset);
  plan.model = preset::name_of(rung);
  plan.model_reason = preset::model_reason(preset);
  plan.levels = scene->levels.edges_per_segment;
  plan.edges_per_segment = plan.levels.back();
  plan.extrapolated = scene->levels.extrapolate;
  plan.rods = int(scene->footprint.rods.size());
  plan.joints = int(scene->footprint.joints.size());
  plan.cells = int(scene->footprint.cells.size());
  plan.dof = dof_of(*scene, rung, plan.edges_per_segment);
  plan.expected_error_mm = rung == preset::Model::net
                               ? net_error * scene->length_scale_mm
                               : expected_error(scene->levels) * scene->length_scale_mm;
  plan.expected_seconds = seconds_for(*scene, rung, preset);
  plan.footprint = fmt::format(
      "{} rods, {} joints, {} cells; longest leg {:.2f} d, shortest {:.2f} d", plan.rods,
      plan.joints, plan.cells, scene->footprint.longest_leg() / scene->footprint.spacing,
      scene->footprint.shortest_leg() / scene->footprint.spacing);
  if (scene->blocks)
    for (const Seam& seam : scene->blocks->seams())
      plan.seams.push_back(fmt::format(
          "{}: {} rods across, at most {:.2f} mm apart, kinked by at most {:.1f} degrees",
          seam.name, seam.rods.size(), seam.max_gap_mm(), seam.max_kink_deg()));
  return plan;
}

namespace {

Result<Outcome> run_whole(const preset::Preset& preset, bool stills, Watch& watch) {
  const auto scene = scene_of(preset);
  if (!scene) return tl::unexpected<Error>(scene.error());
  const bool pushed = preset.indentation.wanted();
  auto outcome =
      pushed ? run_indentation(*scene, preset.indentation, even_samples(preset, stills), watch)
             : actuate(*scene, preset::rung_of(preset), samples_of(preset, stills), watch);
  if (!outcome) return tl::unexpected<Error>(outcome.error());
  if (outcome->trajectory.frames.empty())
    return fail(Fault::no_equilibrium, "no frame was certified: " + outcome->limit_reason);
  record::Summary summary = summary_of(preset, *scene, *outcome);
  return Outcome{std::move(outcome->trajectory), std::move(summary)};
}

}  // namespace

Result<record::Summary> run(const preset::Preset& preset, bool stills, record::Sink& sink,
                            Watch& watch) {
  auto outcome = run_whole(preset, stills, watch);
  if (!outcome) return tl::unexpected<Error>(outcome.error());
  if (auto begun = sink.begin(std::move(outcome->trajectory.layout)); !begun)
    return tl::unexpected<Error>(begun.error());
  for (record::Frame& frame : outcome->trajectory.frames)
    if (auto taken = sink.take(std::move(frame)); !taken)
      return tl::unexpected<Error>(taken.error());
  return std::move(outcome->summary);
}

Result<Outcome> run(const preset::Preset& preset, bool stills, Watch& watch) {
  record::MemorySink sink;
  auto summary = run(preset, stills, sink, watch);
  if (!summary) return tl::unexpected<Error>(summary.error());
  return Outcome{std::move(sink.trajectory()), std::move(*summary)};
}

}  // namespace gridshell::experiment
