// Motion in time: energy, frequency, and the baselines.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/solve/minimise.h"
#include "engine/solve/relaxation.h"
#include "tests/engine/solve/single_rod.h"

using namespace gridshell;

namespace {

constexpr double diameter = 0.254, density = 6450;

Motion bent_at_rest(const Model& model, double length, double chord, double bump) {
  Motion motion;
  motion.x = Eigen::Matrix3Xd::Zero(3, model.nodes);
  motion.velocity = Eigen::Matrix3Xd::Zero(3, model.nodes);
  for (int k = 0; k < model.nodes; ++k) {
    const double s = model.flat(0, k) / length;
    motion.x.col(k) << chord * s, 0, bump * std::sin(M_PI * s);
  }
  return motion;
}

/// A pinned rod along a circular arc of its own length: no strain, chord 0.9 of the length.
Motion arc_at_rest(const Model& model, double length) {
  const double half = 0.786683, R = length / (2 * half);  // sin(half)/half = 0.9
  Motion motion;
  motion.x = Eigen::Matrix3Xd::Zero(3, model.nodes);
  motion.velocity = Eigen::Matrix3Xd::Zero(3, model.nodes);
  for (int k = 0; k < model.nodes; ++k) {
    const double a = half * (2 * model.flat(0, k) / length - 1);
    motion.x.col(k) << R * (std::sin(a) + std::sin(half)), 0, R * (std::cos(a) - std::cos(half));
  }
  return motion;
}

}  // namespace

TEST_CASE("dynamics: a pinned beam's first frequency") {
  const double length = 252;
  const RodSection section = circular_section(diameter, 83);
  const Model model = build_model(single_rod(60, length), section);
  const Eigen::VectorXd mass = lumped_masses(model, density, diameter).value();
  const double per_mm = mass.sum() / length;
  const double exact = M_PI / (2 * length * length) * std::sqrt(section.EI / per_mm);  // 1/s
  Motion motion = bent_at_rest(model, length, length, 1e-4);
  DynamicsOptions options;
  options.step_s = 1 / (400 * exact);
  options.tolerance_mm = 1e-11;
  ImplicitDynamics dynamics(model, mass, options);
  const int middle = 31;  // s = L/2
  REQUIRE(model.flat(0, middle) == Approx(length / 2));
  double before = motion.x(2, middle), first = 0, last = 0;
  int crossings = 0;
  while (crossings < 9) {
    REQUIRE(dynamics.step(motion));
    const double now = motion.x(2, middle);
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

TEST_CASE("dynamics: without damping the energy is kept to second order") {
  // soft in stretching, so that its waves are resolved too
  const double length = 100;
  RodSection section = circular_section(diameter, 83);
  section.EA = 5;
  const Model model = build_model(single_rod(12, length), section);
  const Eigen::VectorXd mass = lumped_masses(model, density, diameter).value();
  const double period = 2 * length * length / M_PI * std::sqrt(mass.sum() / length / section.EI);
  double errors[3];
  for (int k = 0; k < 3; ++k) {
    Motion motion = bent_at_rest(model, length, 0.9 * length, 12);
    motion.x.row(1) = 0.3 * motion.x.row(2);
    const double start = energies_of(model, motion.x).total();
    DynamicsOptions options;
    options.step_s = period / (1000 << k);
    ImplicitDynamics dynamics(model, mass, options);
    errors[k] = 0;
    for (int n = 0; n < 500 << k; ++n) {
      REQUIRE(dynamics.step(motion));
      const double energy = energies_of(model, motion.x).total() + kinetic_energy(mass, motion);
      errors[k] = std::max(errors[k], std::abs(energy / start - 1));
    }
  }
  CAPTURE(errors[0], errors[1], errors[2]);
  CHECK(errors[2] < 1e-2);
  CHECK(std::log2(errors[0] / errors[1]) == Approx(2).margin(0.3));
  CHECK(std::log2(errors[1] / errors[2]) == Approx(2).margin(0.3));
}

TEST_CASE("dynamics: a rod without mass is refused") {
  const Model model = build_model(single_rod(4, 20), circular_section(diameter, 83));
  for (double bad : {0.0, -1.0, std::nan("")}) {
    const auto mass = lumped_masses(model, bad, diameter);
    REQUIRE_FALSE(mass);
    CHECK(mass.error().fault == Fault::bad_input);
    CHECK(mass.error().message.find("density") != std::string::npos);
  }
}

TEST_CASE("baselines: both come to the rest that Newton's method finds, too long a step blows up") {
  const double length = 40;
  const Model model = build_model(single_rod(8, length), circular_section(diameter, 83));
  const Eigen::VectorXd mass = lumped_masses(model, density, diameter).value();
  const Motion start = arc_at_rest(model, length);
  State state{start.x, Eigen::VectorXd::Zero(8)};
  Linearisation system(model);
  REQUIRE(minimise(system, state, {}, Watch()).outcome == NewtonOutcome::converged);

  BaselineOptions options;
  options.step = 0.5;
  options.tolerance_N = 1e-6;
  Eigen::Matrix3Xd x = start.x;
  const BaselineReport relaxed = dynamic_relaxation(model, x, options, Watch());
  CAPTURE(relaxed.steps, relaxed.residual_N);
  REQUIRE(relaxed.end == BaselineEnd::at_rest);
  CHECK((x - state.x).colwise().norm().maxCoeff() < 1e-3);

  options.damping_per_s = 3000;
  Motion motion = start;
  const BaselineReport explicitly = explicit_to_rest(model, mass, motion, options, Watch());
  CAPTURE(explicitly.steps, explicitly.residual_N);
  REQUIRE(explicitly.end == BaselineEnd::at_rest);
  CHECK((motion.x - state.x).colwise().norm().maxCoeff() < 1e-3);

  options.step = 3;
  motion = start;
  CHECK(explicit_to_rest(model, mass, motion, options, Watch()).end == BaselineEnd::blow_up);
  x = start.x;
  CHECK(dynamic_relaxation(model, x, options, Watch()).end == BaselineEnd::blow_up);
}
