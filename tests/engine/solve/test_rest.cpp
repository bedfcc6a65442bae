// Descents from an unstable state: which of them are computed.
#include "engine/elastic/model.h"
#include "tests/engine/solve/crossing_rods.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

const RodMesh mesh = crossing_rods(6);

/// The state that leave_saddle() reaches, and the factorisations that it takes.
struct Rest {
  State state;
  int factorizations = 0;
};

Rest settled(Linearisation& system, const State& from, const Eigen::Matrix3Xd& mode,
             const BranchSwitch& departure) {
  const int before = system.effort().factorizations;
  auto rest = value_of(leave_saddle(system, from, mode, departure, unwatched));
  const int taken = system.effort().factorizations - before;
  CHECK(system.at(rest, false).positive_definite());
  return {rest, taken};
}

}  // namespace

TEST_CASE("of two descents that are mirror images one is taken, always the same one") {
  const Model model = build_model(mesh, circular_section(0.254, 83)).value();
  Linearisation system(model);
  // straight rods compressed slightly past their first buckling load, a dome up or down
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, model.nodes);
  x.topRows(2) = (1 - 1e-5) * model.flat;
  State flat = start_state(model, x);
  REQUIRE(newton(system, flat, {}).outcome == Outcome::reached);
  REQUIRE(system.at(flat, false).negative_pivots == 1);
  const Eigen::Matrix3Xd mode = softest_mode(system, {}, unwatched);

  BranchSwitch departure;
  departure.amplitude_mm = 0.01;
  departure.step_mm = 0.02;
  const Rest both = settled(system, flat, mode, departure);
  departure.symmetries = symmetries_of(mesh, x);
  REQUIRE(departure.symmetries.size() == 16);
  const Rest one = settled(system, flat, mode, departure);
  CHECK(max_column_norm(one.state.x - both.state.x) < 1e-9);
  CHECK(std::abs(one.state.x(2, 0)) > 0.1);
  CHECK(2 * one.factorizations == both.factorizations);

  SECTION("a load that no mirror leaves as it is has both looked at, and the lower one taken") {
    Model loaded = model;
    loaded.loads.push_back({0, {0, 0, 1e-7}});  // N
    Linearisation pulled(loaded);
    pulled.outside.load = 1;
    const Rest up = settled(pulled, flat, mode, departure);
    CHECK(up.state.x(2, 0) > 0.1);
    loaded.loads.back() = {0, {0, 0, -1e-7}};
    Linearisation pressed(loaded);
    pressed.outside.load = 1;
    const Rest down = settled(pressed, flat, mode, departure);
    CHECK(down.state.x(2, 0) < -0.1);
    CHECK(up.factorizations > 1.5 * one.factorizations);
  }
}

TEST_CASE("past a fold one descent is taken, and every requested side ends there") {
  Model model = build_model(mesh, circular_section(0.254, 83)).value();
  model.loads.push_back({0, {0, 0, -1}});  // N: far more than the arch bears
  Linearisation system(model);
  system.outside.load = 0;
  State arch = crossing_arch(model);
  REQUIRE(minimise(system, arch, {}, unwatched).outcome == Outcome::reached);
  REQUIRE(arch.x(2, 0) > 5);
  system.outside.load = 1;
  Eigen::Matrix3Xd down = Eigen::Matrix3Xd::Zero(3, model.nodes);
  down.row(2) = arch.x.row(2);
  BranchSwitch departure;
  // a perturbation so small that both sides descend in one direction, and one after which both
  // descents meet
  departure.amplitude_mm = GENERATE(1e-3, 0.4);
  const Rest any = settled(system, arch, down, departure);
  CHECK(any.state.x(2, 0) < -5);
  for (const BranchSide side : {BranchSide::along, BranchSide::against}) {
    departure.side = side;
    const Rest requested = settled(system, arch, down, departure);
    CHECK(max_column_norm(requested.state.x - any.state.x) < 1e-6);
    CHECK(any.factorizations < 1.6 * requested.factorizations);
  }
}
