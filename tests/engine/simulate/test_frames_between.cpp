// Interpolation between load steps: it agrees with all meshes within its reported errors.
#include "engine/simulate/frames_between.h"

#include "engine/simulate/mesh_policy.h"
#include "tests/engine/simulate/run.h"
#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::simulate;

namespace {

double largest(const Energies& a) {
  double most = std::abs(a.total());
  for (const TermName& term : energy_terms) most = std::max(most, std::abs(a[term.term]));
  return most;
}

/// The number of samples of a segment that are interpolated. Each is compared with the state that
/// is solved for on all meshes, on the same path with a smaller tolerance.
int interpolated_frames(EquilibriumPath& path, EquilibriumPath& closely, int samples) {
  constexpr std::size_t segment = 0;
  Watch watch;
  FramesBetween between(path, watch), backwards(path, watch);
  const double from = path.segments[segment].from, way = path.segments[segment].end() - from;
  const Eigen::Index joints = path.simulation.shell().finest().joints;
  int interpolated = 0;
  for (int k = 1; k < samples; ++k) {
    const PathSample sample{k, segment, from + way * k / samples, 0};
    const auto frame = between.at(sample);
    if (!frame) continue;
    ++interpolated;
    const CertifiedSample stood = certify_sample(closely, sample, watch);
    CAPTURE(k, sample.t, frame->error_estimate_mm);
    REQUIRE(stood.report.end == Outcome::reached);
    const record::Frame full = frame_of(closely.simulation);
    CHECK(max_column_norm(frame->nodes.leftCols(joints) - full.nodes.leftCols(joints)) <
          frame->error_estimate_mm);
    CHECK(largest(frame->energies - full.energies) < frame->energy_error_mJ);
    CHECK(max_column_norm(frame->reactions_N - full.reactions_N) < frame->force_error_N);
    CHECK((frame->cell_K - full.cell_K).cwiseAbs().maxCoeff() < path.simulation.scene().tolerance);
    CHECK((frame->curvature_per_mm - full.curvature_per_mm).cwiseAbs().maxCoeff() <
          1e-2 * full.curvature_per_mm.maxCoeff());
    CHECK(frame->negative_pivots == 0);
    CHECK(frame->kind == "interpolated");
    CHECK(std::isnan(frame->residual_N));
    CHECK(frame->height_mm == Approx(full.height_mm).margin(frame->error_estimate_mm));
    CHECK(frame->largest_bending_strain == Approx(full.largest_bending_strain).epsilon(1e-2));
    CHECK(frame->contacts == full.contacts);
    // independent of the order of the calls
    if (k % 7 == 0) CHECK(backwards.at(sample)->nodes == frame->nodes);
  }
  return interpolated;
}

/// The scene of a preset, with its own tolerance or, `closely`, with one of 1e-6.
std::shared_ptr<const Scene> unloaded_scene(preset::Preset preset, bool closely) {
  if (closely) preset.accuracy.tolerance = 1e-6;
  return shared_scene(preset);
}

/// The path of the actuation of a preset.
EquilibriumPath actuated(const preset::Preset& preset, bool closely = false) {
  return value_of(follow_actuation(unloaded_scene(preset, closely),
                                   initial_levels(*shared_scene(preset)), false, 1, unwatched));
}

}  // namespace

TEST_CASE("frames that are interpolated between load steps are within their errors", "[standard]") {
  preset::Preset p = circle(12, 126, 94.5, 5);
  for (const double tolerance : {1e-3, 1e-4}) {
    p.accuracy.tolerance = tolerance;
    EquilibriumPath path = actuated(p), closely = actuated(p, true);
    CAPTURE(tolerance);
    CHECK(interpolated_frames(path, closely, 60) > 30);
  }
}

TEST_CASE("frames of a push, with its force, are interpolated between load steps", "[standard]") {
  const preset::Preset p = shipped("s4_pole_outward");
  const auto pushed = [&](bool closely) {
    EquilibriumPath shell = value_of(prepare_push(unloaded_scene(p, closely), p.indentation,
                                                  initial_levels(*shared_scene(p)), unwatched));
    follow_segment(shell, 1, {}, unwatched);
    return shell;
  };
  EquilibriumPath path = pushed(false), closely = pushed(true);
  CHECK(interpolated_frames(path, closely, 40) > 25);
}

TEST_CASE("the final frame is solved, also where load steps lie on both sides of it") {
  preset::NetworkData file;
  file.points = {{-100, 0, 0}, {0, 0, 0}, {100, 0, 0}, {0, -100, 0}, {0, 100, 0}};
  file.rods = {{0, 1, 2}, {3, 1, 4}};
  file.supports = {{0, -99, 0, 0}, {2, 99, 0, 0}, {3}, {4}};
  preset::Preset p = network(file);
  p.limits.max_strain = 0.1;
  p.accuracy.tolerance = 1e-4;
  const auto outcome = run_to_end(p);
  CHECK(last_frame(outcome).kind == "solved");
  CHECK(outcome.summary.residual_N < 1e-8);
}

TEST_CASE("no frame is interpolated over a bifurcation", "[standard]") {
  EquilibriumPath path = actuated(circle(12, 126, 94.5, 5));
  const PathSegment& segment = path.segments[0];
  int left = 0;
  Watch watch;
  FramesBetween between(path, watch);
  for (const Event& event : segment.report.events)
    if (event.to) {
      ++left;
      const double t = 0.5 * (load_step_before(segment, event.t).point.t + *event.to);
      CHECK_FALSE(between.at({0, 0, t, 0}));
    }
  CHECK(left > 0);
}

TEST_CASE("between a stable and an unstable load step a state is solved once") {
  preset::Preset p = shipped("s1_actuation");
  EquilibriumPath path =
      value_of(follow_actuation(shared_scene(p), plan_of_mesh(16), true, 1, unwatched));
  const std::vector<LoadStep> steps = path.segments[0].load_steps;
  int turns = 0;
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
    if (steps[k].certificate.stable() == steps[k + 1].certificate.stable()) continue;
    ++turns;
    const double t = 0.4 * steps[k].point.t + 0.6 * steps[k + 1].point.t;
    const Effort before = path.simulation.effort();
    CHECK(certify_sample(path, {0, 0, t, t}, unwatched).report.end == Outcome::reached);
    CHECK((path.simulation.effort() - before).newton_iterations < 12);
  }
  CHECK(turns == 2);
}
