// Loads at which straight and circular rods lose stability: Euler, Greenhill, Michell.
#include "tests/engine/solve/rod_cases.h"

using namespace gridshell;

namespace {

constexpr double EI = 16.95832, EA = 4205.672, GJ = 12.667659, length = 252;
const RodMaterial wire{EA, EI, EI, GJ, {0, 0}, 0};

/// The axial force at which a straight rod between these ends buckles, over EI/L^2.
double euler(int edges, RodEnd hold) {
  const SingleRod single(edges, length, wire, hold, hold);
  const Model model = single.model();
  Linearisation system(model);
  const double strain = critical(0, 60 * EI / (length * length) / EA, [&](double compression) {
    return system.at(start_state(model, single.line(1 - compression)), false).positive_definite();
  });
  return EA * strain * length * length / EI;
}

/// The moment at which a clamped rod under twist buckles, over EI/L.
double greenhill(int edges) {
  const SingleRod single(edges, length, wire, RodEnd::clamped, RodEnd::clamped);
  const Model model = single.model();
  Linearisation system(model);
  const double turn = critical(0, 20 * EI / GJ, [&](double end) {
    State state = start_state(model, single.line());
    // the twist spreads evenly over the rod; half an edge at either end
    for (int k = 0; k < edges; ++k)
      set_angle(model, state, model.rods[0].edges[std::size_t(k + 1)], end * (k + 0.5) / edges);
    set_angle(model, state, model.rods[0].ghost_end, end);
    const Inertia inertia = system.at(state, false);
    CHECK(system.residual() < 1e-9);  // round-off in EA strain; the buckling force is 1e-2
    return inertia.positive_definite();
  });
  return turn * GJ / EI;
}

/// The twist at which a closed ring buckles out of its plane.
double michell(int edges, double ratio) {
  RodMaterial material = wire;
  material.GJ = ratio * EI;
  ModelRod rod{{}, {}, material, RodEnd::free, RodEnd::free};
  const double around = 2 * M_PI * 40;
  Eigen::Matrix3Xd x(3, edges);
  for (int k = 0; k <= edges; ++k) {
    rod.position.push_back(around * k / edges);
    if (k == edges) break;
    rod.nodes.push_back(k);
    const double a = 2 * M_PI * k / edges, r = around / edges / (2 * std::sin(M_PI / edges));
    x.col(k) << r * std::cos(a), r * std::sin(a), 0;
  }
  Model model = build_model(edges, {rod}, RodModel::twist).value();
  // six unknowns that hold the ring in space and do no more
  const int third = edges / 3;
  model.pin(0);
  model.hold(third, 0);
  model.hold(third, 2);
  model.hold(2 * third, 2);
  finish(model);
  Linearisation system(model);
  const State flat = start_state(model, x);
  const double expected = 2 * M_PI * std::sqrt(3) / ratio;
  return critical(
             0.5 * expected, 1.5 * expected,
             [&](double twist) {
               State state = flat;
               // cut, turned and closed again: the last bend rests turned, all share it
               std::get<std::vector<Pair<Torsion>>>(model.pairs).back().law.rest = -twist;
               for (int k = 0; k < edges; ++k) set_angle(model, state, k, twist * k / edges);
               REQUIRE(newton(system, state, {.tolerance_mm = 1e-6}).outcome == Outcome::reached);
               // of 40 mm: still plane
               REQUIRE(state.x.row(2).leftCols(edges).cwiseAbs().maxCoeff() < 1e-4);
               return system.at(state, false).positive_definite();
             }) /
         expected;
}

}  // namespace

TEST_CASE("Euler: pinned and clamped rods buckle at pi^2 and 4 pi^2 EI/L^2, second order") {
  const double pinned = M_PI * M_PI, clamped = 4 * M_PI * M_PI;
  const double p40 = euler(40, RodEnd::pinned), p80 = euler(80, RodEnd::pinned);
  CHECK(p80 == Approx(pinned).epsilon(1e-3));
  CHECK(order(std::abs(p40 - pinned), std::abs(p80 - pinned)) == Approx(2).margin(0.15));
  for (RodEnd hold : {RodEnd::tangent, RodEnd::clamped}) {
    const double c40 = euler(40, hold), c80 = euler(80, hold);
    CAPTURE(c40 / clamped, c80 / clamped);
    CHECK(c80 == Approx(clamped).epsilon(1e-3));
    CHECK(order(std::abs(c40 - clamped), std::abs(c80 - clamped)) == Approx(2).margin(0.15));
  }
}

TEST_CASE("a clamped rod under twist buckles at 8.98682 EI/L, second order") {
  const double exact = 8.98681891581813;  // 2x, tan x = x
  const double c40 = greenhill(40), c80 = greenhill(80);
  CAPTURE(c40 / exact, c80 / exact);
  CHECK(c80 == Approx(exact).epsilon(1e-3));
  CHECK(order(std::abs(c40 - exact), std::abs(c80 - exact)) == Approx(2).margin(0.15));
}

TEST_CASE("Michell's ring buckles at 2 pi sqrt(3) EI/GJ") {
  for (double ratio : {0.5, 0.75, 1.0, 2.0}) {
    const double coarse = michell(30, ratio), fine = michell(60, ratio);
    CAPTURE(ratio, coarse, fine);
    CHECK(fine == Approx(1).epsilon(1e-2));
    CHECK(order(std::abs(coarse - 1), std::abs(fine - 1)) == Approx(2).margin(0.2));
  }
}
