// Arc length through the limit points of an arch under a dead load.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/elastic/model.h"
#include "engine/solve/arc_follower.h"
#include "tests/engine/solve/crossing_rods.h"

using namespace gridshell;

namespace {

/// The force on the joint at `height`, to which a prescribed displacement moves it from `state`.
double force_at(const Model& unloaded, State state, double height) {
  Linearisation system(unloaded);
  const Constraint held{0, Eigen::Vector3d::UnitZ()};
  system.constrain({held});
  const double begin = state.x(2, 0);
  constexpr int steps = 60;
  for (int k = 1; k <= steps; ++k) {
    state.x(2, 0) = begin + (height - begin) * k / steps;
    REQUIRE(newton(system, state, {.tolerance_mm = 1e-9}).last_move_mm < 1e-6);
  }
  system.gradient_at(state);
  return -system.reaction(held).z();
}

}  // namespace

TEST_CASE("by arc length an arch is followed over the limit of its load and back to no load") {
  const Model unloaded = build_model(crossing_rods(6), circular_section(0.254, 83)).value();
  Model model = unloaded;
  model.loads.push_back({0, {0, 0, -1}});  // N: the parameter is the force
  Linearisation system(model);
  State arch = crossing_arch(model);
  system.outside.load = 0;
  REQUIRE(minimise(system, arch, {}, unwatched).outcome == Outcome::reached);
  const double height = arch.x(2, 0);
  const PinnedMotion motion{arch.x, Eigen::Matrix3Xd::Zero(3, model.nodes), PathLaw::even};
  ArcFollower path(system, motion, {.step_mm = 0.1, .largest_mm = 0.2, .parameter_mm = 20});
  const PathPoint begin{0, arch, {}};
  const auto turn =
      turning_point(system, motion, begin, 1, {.step_mm = 0.5, .parameter_mm = 20}, unwatched);
  REQUIRE(path.start(0, arch) == Outcome::reached);
  CHECK(path.at().inertia.positive_definite());

  double most = 0;
  int checked = 0, unstable = 0;
  bool unloaded_again = false;
  for (int k = 0; k < 80 && !unloaded_again; ++k) {
    REQUIRE(path.step() == Outcome::reached);
    const PathPoint& point = path.at().point;
    most = std::max(most, point.t);
    unstable += !path.at().inertia.positive_definite();
    // the same curve by displacement control, before the limit point and past it
    const double z = point.state.x(2, 0);
    if ((checked < 1 && z < 0.8 * height) || (checked < 2 && z < 0.3 * height)) {
      ++checked;
      CHECK(point.t == Approx(force_at(unloaded, arch, z)).epsilon(1e-6));
    }
    unloaded_again = point.t < 0;
  }
  CHECK(checked == 2);
  CHECK(most > 0.05);
  REQUIRE(turn);
  CHECK(*turn == Approx(most).epsilon(0.02));
  CHECK(unstable > 0);
  // past the limit point the load falls to zero: another equilibrium of the unloaded arch, with its
  // middle below the pins and unstable
  REQUIRE(unloaded_again);
  State rest = path.at().point.state;
  const Eigen::Matrix3Xd there = rest.x;
  system.outside.load = 0;
  REQUIRE(newton(system, rest, {}).outcome == Outcome::reached);
  CHECK(max_column_norm(rest.x - there) < 0.3);
  CHECK(rest.x(2, 0) < 0);
  CHECK_FALSE(system.at(rest, false).positive_definite());
}

TEST_CASE("a step without length is lost, not endless") {
  const Model model = build_model(crossing_rods(2), circular_section(0.254, 83)).value();
  Linearisation system(model);
  const State arch = crossing_arch(model);
  const PinnedMotion motion{arch.x, Eigen::Matrix3Xd::Zero(3, model.nodes), PathLaw::even};
  ArcFollower path(system, motion, {.step_mm = 0, .smallest_mm = 0});
  REQUIRE(path.start(0, arch) == Outcome::reached);
  CHECK(path.step() == Outcome::lost);
}
