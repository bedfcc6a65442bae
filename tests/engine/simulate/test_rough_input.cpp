// Inputs on which earlier solvers failed: each run ends in the right state or with a reason, never
// in a wrong state.
#include <cmath>

#include "tests/engine/simulate/run.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

std::shared_ptr<const Scene> fig1(double tolerance = 1e-4) {
  preset::Preset p = circle(12, 126, 94.5);
  p.imperfection.size = 0;  // the state with two mirrors
  p.accuracy.tolerance = tolerance;
  return shared_scene(p);
}

/// A path with the frames that were sampled from it.
struct Run {
  simulate::EquilibriumPath course;
  record::Trajectory trajectory;
};

Result<Run> run(std::shared_ptr<const Scene> scene, const std::vector<double>& progress) {
  Watch watch;
  record::MemorySink sink;
  auto course = simulate::run_actuation(std::move(scene), progress, sink, watch);
  if (!course) return tl::unexpected<Error>(course.error());
  return Run{std::move(*course), std::move(sink.trajectory())};
}

Result<Run> end_of(std::shared_ptr<const Scene> scene) { return run(std::move(scene), {1.0}); }

/// Checks that a run ended in a certified state or with a reason; returns whether the state is
/// certified.
bool certified_or_named(const Result<Run>& outcome, double residual_N = 1e-8) {
  if (!outcome) {
    CHECK(outcome.error().fault == Fault::no_equilibrium);
    CHECK_FALSE(outcome.error().message.empty());
    return false;
  }
  if (outcome->trajectory.frames.empty()) {
    CHECK(outcome->course.limit != record::Limit::none);
    CHECK_FALSE(outcome->course.limit_reason.empty());
    return false;
  }
  const record::Frame& frame = outcome->trajectory.frames.back();
  CHECK(frame.negative_pivots == 0);
  CHECK(std::isfinite(frame.nodes.sum()));
  if (frame.event == "locking") {
    // a path that ends before its end has converged there to its tolerance, not to round-off
    CHECK(frame.residual_N < 1e-3 * frame.largest_force_N);
    CHECK(outcome->course.limit == record::Limit::locking);
    CHECK(frame.actuation < 1);
    return false;
  }
  CHECK(frame.residual_N < residual_N);
  CHECK(frame.energies[Term::bend] > 1);  // no planar saddle
  return true;
}

}  // namespace

TEST_CASE("EA from a hundredth to ten thousand times: the same state, or a reason", "[standard]") {
  const double reference = end_of(fig1())->trajectory.frames.back().energies[Term::bend];
  int certified = 0;
  for (double scale : {1e-2, 1e-1, 1e1, 1e2, 1e4}) {
    Scene scene = *fig1();
    for (RodMaterial& material : scene.rods.materials) material.EA *= scale;
    scene.max_strain = 1;
    INFO("EA x " << scale);
    const auto outcome = end_of(std::make_shared<const Scene>(scene));
    // residuals are due to round-off in EA x strain
    if (!certified_or_named(outcome, std::max(1e-8, 1e-9 * scale))) continue;
    ++certified;
    // rods stretch as well as bend: with strains of about 1e-3/scale the energies differ by as much
    const double softness = std::max(1e-3, 2e-3 / scale);
    CHECK(outcome->trajectory.frames.back().energies[Term::bend] ==
          Approx(reference).epsilon(softness));
  }
  CHECK(certified == 5);
}

TEST_CASE("legs down to a ten-thousandth of a cell: certified, or a reason") {
  int certified = 0;
  for (double leg : {1e-1, 5e-2, 1e-2, 1e-3, 1e-4}) {
    preset::Preset p;
    p.footprint.radius_mm = std::hypot(110 + 20 * leg, 10);
    p.actuation.radius_mm = 0.9 * p.footprint.radius_mm;
    p.accuracy.tolerance = 1e-3;
    const auto scene = shared_scene(p);
    CHECK(scene->footprint.shortest_leg() < 1.2 * 20 * leg);
    const auto outcome = end_of(scene);
    INFO("leg " << leg << " d");
    certified += certified_or_named(outcome);
  }
  CHECK(certified >= 2);
}

TEST_CASE("tolerances from 1e-2 to 1e-7 give one state", "[standard]") {
  const auto exact = end_of(fig1(1e-7));
  REQUIRE(certified_or_named(exact));
  for (double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const auto outcome = end_of(fig1(tolerance));
    INFO("tolerance " << tolerance);
    REQUIRE(certified_or_named(outcome));
    const auto& frame = outcome->trajectory.frames.back();
    const double worst =
        max_column_norm(joints_of(outcome->trajectory) - joints_of(exact->trajectory));
    CHECK(worst <= tolerance * 126);
    CHECK(worst < 2 * frame.error_estimate_mm);
  }
}

TEST_CASE("down to half the radius: certified states, each on the one before") {
  preset::Preset p;
  p.actuation.radius_mm = 63;
  p.accuracy.tolerance = 1e-3;
  const auto scene = shared_scene(p);
  std::vector<double> samples;
  for (int k = 1; k <= 20; ++k) samples.push_back(k / 20.0);
  const auto outcome = run(scene, samples);
  CHECK(certified_or_named(outcome));
  REQUIRE(outcome->trajectory.frames.size() == 20);
  double energy = 0;
  for (const record::Frame& frame : outcome->trajectory.frames) {
    if (!frame.event.empty()) continue;
    CHECK(frame.negative_pivots == 0);
    CHECK(frame.energies[Term::bend] > energy);
    energy = frame.energies[Term::bend];
  }
}

TEST_CASE("rods that reach their length end as locking, with nothing after it") {
  Scene scene = *fig1(1e-3);
  scene.max_strain = 1e-7;
  const auto outcome = value_of(end_of(std::make_shared<const Scene>(scene)));
  CHECK(outcome.course.limit == record::Limit::locking);
  // the state at the limit is shown
  REQUIRE(outcome.trajectory.frames.size() == 1);
  const record::Frame& last = outcome.trajectory.frames.front();
  CHECK(last.event == "locking");
  CHECK(last.negative_pivots == 0);
  CHECK(last.progress < 1);
}
