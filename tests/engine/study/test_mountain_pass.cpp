#include "engine/study/mountain_pass.h"

#include "engine/elastic/model.h"
#include "tests/engine/solve/rod_cases.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

/// A rod between pins nearer to one another than it is long, confined to the xz-plane by the
/// ground.
struct Arch {
  SingleRod rod;
  Model model;

  Arch(int edges, double length, double span)
      : rod(edges, length, {.EA = 4205.672, .EI1 = 16.95832, .EI2 = 16.95832}, RodEnd::pinned,
            RodEnd::pinned),
        model(build_model(edges + 1, {rod.rod}, RodModel::bend).value()),
        shortening(span / length) {
    model.pin(0);
    model.pin(edges);
    for (int node = 1; node < edges; ++node)
      model.ground.push_back({.node = node, .stiffness = {0, 1, 0}});
    finish(model);
  }

  /// Equilibrium from a bump of `bump` half waves.
  State rest(Linearisation& system, double bump) const {
    State state = start_state(model, rod.line(shortening, bump));
    state.force.setZero();
    REQUIRE(minimise(system, state, {.tolerance_mm = 1e-9}, unwatched).outcome == Outcome::reached);
    return state;
  }
  double shortening;
};

}  // namespace

TEST_CASE("an arch snaps over the pass of two half waves, each half an arch of its own") {
  const int edges = 24;
  const double length = 252, span = 220;
  const Arch whole(edges, length, span), half(edges / 2, length / 2, span / 2);
  Linearisation system(whole.model), of_half(half.model);
  const State up = whole.rest(system, 40), down = whole.rest(system, -40);
  const MountainPass pass = mountain_pass(system, up, down, 2, unwatched);
  REQUIRE(pass.outcome == Outcome::reached);
  // the middle of the s-shape is neither moved nor bent
  const double expected = 2 * of_half.energy_at(half.rest(of_half, 20));
  CHECK(pass.energy_mJ == Approx(expected).epsilon(1e-8));
  CHECK(pass.energy_mJ > 3.5 * system.energy_at(up));
  CHECK(pass.residual_N < 1e-8);
  // its two sides lead to the two wells
  for (const auto& [side, well] :
       {std::pair(BranchSide::against, &up), {BranchSide::along, &down}}) {
    BranchSwitch departure;
    departure.side = side;
    const auto rest =
        value_of(leave_saddle(system, pass.saddle, pass.towards_b, departure, unwatched));
    CHECK(max_column_norm(rest.x - well->x) < 1e-4);
  }
}

TEST_CASE("a truss of two bars snaps through the flat") {
  // E(z) = EA/l (sqrt(a^2 + z^2) - l)^2, so that the barrier is EA (l - a)^2/l
  const double EA = 100, l = 10, rise = 1, a = std::sqrt(l * l - rise * rise);
  Model model;
  model = build_model(3, {{{0, 1, 2}, {0, l, 2 * l}, {.EA = EA, .EI1 = 1e-9, .EI2 = 1e-9}}},
                      RodModel::bend)
              .value();
  model.pin(0);
  model.pin(2);
  model.ground.push_back({.node = 1, .stiffness = {0, 10, 0}});
  finish(model);
  Linearisation system(model);
  const auto at = [&](double z) {
    Eigen::Matrix3Xd x(3, 3);
    x << 0, a, 2 * a, 0, 0, 0, 0, z, 0;
    return start_state(model, x);
  };
  const MountainPass pass = mountain_pass(system, at(rise), at(-rise), 0.2, unwatched);
  REQUIRE(pass.outcome == Outcome::reached);
  CHECK(pass.energy_mJ == Approx(EA * (l - a) * (l - a) / l).epsilon(1e-6));
  CHECK(std::abs(pass.saddle.x(2, 1)) < 1e-6);
}

TEST_CASE("a path from a state to itself has no pass") {
  const Arch arch(12, 126, 110);
  Linearisation system(arch.model);
  const State up = arch.rest(system, 20);
  CHECK(mountain_pass(system, up, up, 2, unwatched).outcome == Outcome::not_converged);
}
