// Runs of presets that must succeed; where one does not, the test fails with the reason.
#pragma once

#include "engine/simulate/run.h"
#include "tests/presets.h"

namespace gridshell {

/// Runs a preset, with the frames of a movie or of a figure.
inline simulate::ExperimentResult run(const preset::Preset& preset, bool stills = false) {
  Watch watch;
  return value_of(simulate::run(preset, stills, watch));
}

/// Runs a preset, and checks that its path is complete and ends in a stable state.
inline simulate::ExperimentResult run_to_end(const preset::Preset& preset, bool stills = false) {
  auto outcome = run(preset, stills);
  INFO(outcome.summary.limit_reason);
  CHECK(outcome.summary.limit == record::Limit::none);
  CHECK(outcome.summary.stable);
  return outcome;
}

/// Runs a preset with the frames of a figure.
inline simulate::ExperimentResult run_stills(const preset::Preset& preset) {
  return run(preset, true);
}

/// The message with which the run is refused.
inline std::string refused_run(const preset::Preset& preset, Fault fault = Fault::bad_input) {
  Watch watch;
  return refusal(simulate::run(preset, false, watch), fault);
}

inline const record::Frame& last_frame(const simulate::ExperimentResult& outcome) {
  return outcome.trajectory.frames.back();
}

/// Positions of the joints in the last frame, 3 x joints, mm.
inline Eigen::Matrix3Xd joints_of(const record::Trajectory& trajectory) {
  return trajectory.frames.back().nodes.leftCols(Eigen::Index(trajectory.layout.joints.size()));
}

/// The largest distance between equal joints in the last frames of two runs, mm.
inline double distance(const simulate::ExperimentResult& a, const simulate::ExperimentResult& b) {
  return max_column_norm(joints_of(a.trajectory) - joints_of(b.trajectory));
}

inline std::shared_ptr<const Scene> shared_scene(const preset::Preset& preset) {
  return std::make_shared<const Scene>(value_of(scene_of(preset)));
}

/// A simulation at the end of the actuation, on the meshes of `plan`, whose first buckled state is
/// computed at the relative shortening `shortening`.
inline Simulation formed(const preset::Preset& preset, const LevelPlan& plan,
                         double shortening = 0.02) {
  Simulation simulation = value_of(Simulation::open(shared_scene(preset), plan));
  REQUIRE(value_of(simulation.begin_buckled(shortening, unwatched)).end == Outcome::reached);
  REQUIRE(simulation.move_to(1, unwatched).end == Outcome::reached);
  CHECK(simulation.certificate().stable());
  return simulation;
}
inline Simulation formed(const preset::Preset& preset) {
  return formed(preset, plan_levels(preset.accuracy.tolerance));
}

/// A shell in equilibrium next to its net, on one mesh and the coarser ones nested in it.
inline Simulation on_its_net(std::shared_ptr<const Scene> scene, int edges) {
  Simulation session = value_of(Simulation::open(std::move(scene), plan_of_mesh(edges)));
  const Report begun = value_of(session.begin_on_net(unwatched));
  CHECK(begun.end == Outcome::reached);
  CHECK(begun.certificate.stable());
  return session;
}

}  // namespace gridshell
