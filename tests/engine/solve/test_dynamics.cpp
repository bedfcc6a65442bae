// Motion in time: frequency, mass, and the baselines.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/solve/dynamics.h"
#include "engine/solve/equilibrium.h"
#include "engine/study/relaxation.h"
#include "tests/engine/solve/single_rod.h"

using namespace gridshell;
using namespace gridshell::study;

namespace {

constexpr double diameter = 0.254, density = 6450;

MovingState bent_at_rest(const Model& model, double length, double chord, double bump) {
  Eigen::Matrix3Xd x(3, model.nodes);
  for (int k = 0; k < model.nodes; ++k) {
    const double s = model.flat(0, k) / length;
    x.col(k) << chord * s, 0, bump * std::sin(M_PI * s);
  }
  return MovingState::at_rest(start_state(model, x));
}

/// A pinned rod along a circular arc of its own length: no strain, chord 0.9 of the length.
MovingState arc_at_rest(const Model& model, double length) {
  const double half = 0.786683, R = length / (2 * half);  // sin(half)/half = 0.9
  Eigen::Matrix3Xd x(3, model.nodes);
  for (int k = 0; k < model.nodes; ++k) {
    const double a = half * (2 * model.flat(0, k) / length - 1);
    x.col(k) << R * (std::sin(a) + std::sin(half)), 0, R * (std::cos(a) - std::cos(half));
  }
  return MovingState::at_rest(start_state(model, x));
}

}  // namespace

TEST_CASE("dynamics: a pinned beam's first frequency") {
  const double length = 252;
  const RodSection section = circular_section(diameter, 83);
  const Model model = build_model(single_rod(60, length), section).value();
  const Eigen::Matrix3Xd mass =
      lumped_mass(model, {round_mass_t_per_mm(density, diameter)}).value();
  const double per_mm = mass.row(0).sum() / length;
  const double exact = M_PI / (2 * length * length) * std::sqrt(section.EI / per_mm);  // 1/s
  MovingState motion = bent_at_rest(model, length, length, 1e-4);
  DynamicsOptions options;
  options.step_s = 1 / (400 * exact);
  options.tolerance_mm = 1e-11;
  DampedMotion dynamics(model, mass, options);
  const int middle = 31;  // s = L/2
  REQUIRE(model.flat(0, middle) == Approx(length / 2));
  double before = motion.state.x(2, middle), first = 0, last = 0;
  int crossings = 0;
  while (crossings < 9) {
    REQUIRE(dynamics.step(motion));
    const double now = motion.state.x(2, middle);
    if ((now > 0) != (before > 0)) {
      last = motion.time - options.step_s * now / (now - before);
      if (crossings++ == 0) first = last;
    }
    before = now;
  }
  const double found = 4 / (last - first);  // eight half periods
  CAPTURE(found, exact);
  CHECK(found == Approx(exact).epsilon(1e-3));
}

TEST_CASE("dynamics: a rod without mass is refused") {
  const Model model = build_model(single_rod(4, 20), circular_section(diameter, 83)).value();
  for (double bad : {0.0, -1.0, std::nan("")}) {
    const auto mass = lumped_mass(model, {round_mass_t_per_mm(bad, diameter)});
    REQUIRE_FALSE(mass);
    CHECK(mass.error().fault == Fault::bad_input);
    CHECK(mass.error().message.find("density") != std::string::npos);
  }
}

TEST_CASE("baselines: both come to the rest that Newton's method finds, too long a step blows up") {
  const double length = 40;
  const Model model = build_model(single_rod(8, length), circular_section(diameter, 83)).value();
  const Eigen::Matrix3Xd mass =
      lumped_mass(model, {round_mass_t_per_mm(density, diameter)}).value();
  const MovingState start = arc_at_rest(model, length);
  State state = start.state;
  Linearisation system(model);
  REQUIRE(minimise(system, state, {}, Watch()).outcome == Outcome::reached);

  BaselineOptions options;
  options.step = 0.5;
  options.tolerance_N = 1e-6;
  State x = start.state;
  const BaselineReport relaxed = dynamic_relaxation(model, x, options, Watch());
  CAPTURE(relaxed.steps, relaxed.residual_N);
  REQUIRE(relaxed.end == Outcome::reached);
  CHECK((x.x - state.x).colwise().norm().maxCoeff() < 1e-3);

  options.damping_per_s = 3000;
  MovingState motion = start;
  const BaselineReport explicitly = explicit_to_rest(model, mass, motion, options, Watch());
  CAPTURE(explicitly.steps, explicitly.residual_N);
  REQUIRE(explicitly.end == Outcome::reached);
  CHECK((motion.state.x - state.x).colwise().norm().maxCoeff() < 1e-3);

  options.step = 3;
  motion = start;
  CHECK(explicit_to_rest(model, mass, motion, options, Watch()).end == Outcome::not_finite);
  x = start.state;
  CHECK(dynamic_relaxation(model, x, options, Watch()).end == Outcome::not_finite);
}
