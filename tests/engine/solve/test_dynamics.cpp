// Motion in time: frequency, order, damping, mass and the snap of a shallow arch of two crossing
// rods.
#include "engine/solve/dynamics.h"

#include <cmath>

#include "engine/elastic/model.h"
#include "tests/engine/solve/crossing_rods.h"
#include "tests/engine/solve/single_rod.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

constexpr double diameter = 0.254, density = 6450;

Result<Eigen::Matrix3Xd> mass_of(const Model& model, double kg_m3 = density) {
  return lumped_mass(model, {round_mass_t_per_mm(kg_m3, diameter)});
}

}  // namespace

TEST_CASE("dynamics: a pinned beam's first frequency") {
  const double length = 252;
  const RodSection section = circular_section(diameter, 83);
  const Model model = build_model(single_rod(60, length), section).value();
  const Eigen::Matrix3Xd mass = mass_of(model).value();
  const double per_mm = mass.row(0).sum() / length;
  const double exact = M_PI / (2 * length * length) * std::sqrt(section.EI / per_mm);  // 1/s
  MovingState motion = MovingState::at_rest(start_state(model, straight(model, 1, 1e-4)));
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
  CHECK(4 / (last - first) == Approx(exact).epsilon(1e-3));  // eight half periods
}

TEST_CASE("damped motion: second order in the step, a slow vibration dies as its damping says") {
  const double length = 100;
  RodSection section = circular_section(diameter, 83);
  section.EA = 5;  // so soft that the steps resolve longitudinal waves, too
  const Model model = build_model(single_rod(12, length), section).value();
  const Eigen::Matrix3Xd mass = mass_of(model).value();
  const double period =
      2 * length * length / M_PI * std::sqrt(mass.row(0).sum() / length / section.EI);
  const auto after = [&](double periods, int steps, double damping) {
    MovingState motion = MovingState::at_rest(start_state(model, straight(model, 1, 0.1)));
    DynamicsOptions options;
    options.step_s = periods * period / steps;
    options.damping_per_s = damping;
    options.tolerance_mm = 1e-11;
    DampedMotion moving(model, mass, options);
    for (int n = 0; n < steps; ++n) REQUIRE(moving.step(motion));
    return motion.state.x;
  };
  // off the turning point, where an error of phase shows
  const Eigen::Matrix3Xd exact = after(0.7, 640, 0);
  const double coarse = max_column_norm(after(0.7, 40, 0) - exact),
               fine = max_column_norm(after(0.7, 80, 0) - exact);
  CAPTURE(coarse, fine);
  CHECK(std::log2(coarse / fine) == Approx(2).margin(0.2));
  // after a period the rod is as at the start, reduced by exp(-c T/2)
  const double c = 0.4 / period;
  const int middle = 7;
  REQUIRE(model.flat(0, middle) == Approx(length / 2));
  CHECK(after(1, 320, c)(2, middle) / after(1, 320, 0)(2, middle) ==
        Approx(std::exp(-0.2)).epsilon(5e-3));
}

TEST_CASE("a shallow arch of two crossing rods snaps in time and ends in a certified equilibrium") {
  const Model model = build_model(crossing_rods(6), circular_section(diameter, 83)).value();
  Linearisation system(model);
  State state = crossing_arch(model);  // its ends come 2 % together
  REQUIRE(minimise(system, state, {}, unwatched).outcome == Outcome::reached);
  const double height = state.x(2, 0);
  REQUIRE(height > 5);

  // down by displacement of the joint until the equilibrium is not stable any more
  for (const bool lateral_free : {true, false}) {
    CAPTURE(lateral_free);
    Constraint held{0};
    if (lateral_free) held.directions = Eigen::Vector3d::UnitZ();
    system.constrain({held});
    State pushed = state;
    bool flagged = false;
    while (!flagged && pushed.x(2, 0) > -height) {
      pushed.x(2, 0) -= height / 40;
      REQUIRE(newton(system, pushed, {.tolerance_mm = 1e-8}).last_move_mm < 1e-4);
      flagged = !system.at(pushed, false).positive_definite();
    }
    REQUIRE(flagged);
    REQUIRE(pushed.x(2, 0) > 0);

    // from there in time, with the joint fixed at its position
    DynamicsOptions options;
    options.step_s = 1e-3;
    options.damping_per_s = 40;
    DampedMotion moving(model, mass_of(model).value(), options, {}, {held});
    MovingState motion = MovingState::at_rest(pushed);
    for (int node :
         model.free_columns)  // a perturbation: an unstable equilibrium could last for ever
      if (node != 0)
        motion.velocity.col(node) << std::sin(1.3 * node), std::cos(2.1 * node),
            std::sin(0.7 * node);
    const double before = energies_of(model, pushed).total();
    int steps = 0;
    const auto settled = moving.settle(
        motion, {}, [&](const MovingState&) { ++steps; }, unwatched);
    INFO((settled ? std::string() : settled.error().message));
    REQUIRE(settled);
    CHECK(steps > 10);
    CHECK(held.part(motion.state.x.col(0) - pushed.x.col(0)).norm() < 1e-9);
    CHECK(energies_of(model, motion.state).total() < 0.999 * before);
    CHECK(max_column_norm(motion.state.x - pushed.x) > 0.5);

    // the static solver has next to nothing to correct there, and certifies it
    State rest = motion.state;
    system.gradient_at(rest);
    rest.force = system.assembly().force;
    const NewtonReport report = newton(system, rest, {});
    REQUIRE(report.outcome == Outcome::reached);
    CHECK(report.first_move_mm < 1e-2);
    CHECK(system.at(rest, false).positive_definite());
    system.constrain({});
  }
}

TEST_CASE("dynamics: a rod without mass is refused") {
  const Model model = build_model(single_rod(4, 20), circular_section(diameter, 83)).value();
  for (double bad : {0.0, -1.0, std::nan("")})
    CHECK_THAT(refusal(mass_of(model, bad)), Catch::Contains("density"));
}
