// Twisted rods with known solutions: equilibrium shapes (the elastica, a cantilever, a helix, the
// localised helix), buckling loads (Euler, Greenhill, Michell), and a joint's shear.
#include "engine/elastic/model.h"
#include "engine/elastic/rod_frame.h"
#include "tests/engine/solve/elastica.h"
#include "tests/engine/solve/rod_cases.h"

using namespace gridshell;

namespace {

constexpr double EI = 16.95832, EA = 4205.672, GJ = 12.667659, length = 252;
const RodMaterial wire{EA, EI, EI, GJ, {0, 0}, 0};
const RodMaterial stiff_wire{10 * EA, EI, EI, GJ, {0, 0}, 0};

/// Height over L of a pinned rod whose ends approach each other, from an initial state in which the
/// angles of its edges are random.
double elastica_height(int edges, double shortening) {
  const SingleRod single(edges, length, stiff_wire, RodEnd::pinned, RodEnd::pinned);
  const Model model = single.model();
  Linearisation system(model);
  State state =
      start_state(model, single.line(1 - shortening, 0.6 * std::sqrt(shortening) * length));
  for (int k = 0; k < edges; ++k) set_angle(model, state, k, std::sin(12.9898 * (k + 1)));
  settle(system, state);
  CHECK(energies_of(model, state)[Term::twist] < 1e-12);
  // it may turn about the line of its pins
  return state.x.bottomRows(2).leftCols(edges + 1).colwise().norm().maxCoeff() / length;
}

/// Tip of a cantilever under a dead end load P = load EI/L^2, over L: (along, across).
Eigen::Vector2d cantilever(int edges, double load) {
  const SingleRod single(edges, length, stiff_wire, RodEnd::clamped, RodEnd::free);
  Model model = single.model();
  model.loads.push_back({edges, {0, 0, -EI / (length * length)}});
  Linearisation system(model);
  State state = start_state(model, single.line());
  const double step = 0.25;
  for (double P = step; P <= load + 1e-9; P += step) {
    system.outside.load = P;
    settle(system, state);
  }
  return {state.x(0, edges) / length, -state.x(2, edges) / length};
}

/// Solution by shooting for the slope at its root: theta'' = -a cos theta, theta(0) = 0, theta'(1)
/// = 0.
Eigen::Vector2d cantilever_exact(double a) {
  const auto end = [&](double slope) {
    return shot(0, slope, 1, [&](double, double theta) { return -a * std::cos(theta); });
  };
  return end(zero_of([&](double slope) { return end(slope)[1]; }, 0, a + 1)).tail<2>().reverse();
}

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
  ModelRod rod{{}, {}, material, {}, {}, RodEnd::free, RodEnd::free};
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
  // six unknowns that fix the ring in space and nothing more
  const int third = edges / 3;
  model.pin(0);
  model.fix(third, 0);
  model.fix(third, 2);
  model.fix(2 * third, 2);
  finish(model);
  Linearisation system(model);
  const State flat = start_state(model, x);
  const double expected = 2 * M_PI * std::sqrt(3) / ratio;
  return critical(
             0.5 * expected, 1.5 * expected,
             [&](double twist) {
               State state = flat;
               // cut, twisted and closed again: the last torsion element has the natural angle, all
               // edges twist
               std::get<std::vector<Pair<Torsion>>>(model.pairs).back().law.rest = -twist;
               for (int k = 0; k < edges; ++k) set_angle(model, state, k, twist * k / edges);
               REQUIRE(newton(system, state, {.tolerance_mm = 1e-6}).outcome == Outcome::reached);
               // the ring of radius 40 mm is still plane
               REQUIRE(state.x.row(2).leftCols(edges).cwiseAbs().maxCoeff() < 1e-4);
               return system.at(state, false).positive_definite();
             }) /
         expected;
}

/// Checks that a value on twice the edges is near to `exact`, and that its error falls with second
/// order.
template <class Found>
void check_second_order(const Found& found, int edges, double exact, double near, double margin) {
  const double coarse = std::abs(found(edges) - exact), fine = std::abs(found(2 * edges) - exact);
  CAPTURE(edges, exact, coarse, fine);
  CHECK(fine < near * exact);
  CHECK(order(coarse, fine) == Approx(2).margin(margin));
}

}  // namespace

TEST_CASE("twist model: the pinned elastica from random edge angles, second order") {
  for (const auto& [shortening, m] : {std::pair(0.1, 0.09871763), {0.5, 0.46400983}}) {
    const double exact = std::sqrt(m) / std::comp_ellint_1(std::sqrt(m));
    check_second_order([by = shortening](int edges) { return elastica_height(edges, by); }, 26,
                       exact, 5e-4 / exact, 0.15);
  }
}

TEST_CASE("twist model: a cantilever under an end load, large deflection, second order") {
  // the table of Bisshopp and Drucker [1945]: deflection over L
  for (const auto& [load, deflection] : {std::pair(1.0, 0.30172), {5.0, 0.71379}}) {
    const Eigen::Vector2d exact = cantilever_exact(load);
    CHECK(exact.y() == Approx(deflection).margin(1e-5));
    const double coarse = (cantilever(25, load) - exact).norm(),
                 fine = (cantilever(50, load) - exact).norm();
    CAPTURE(load, coarse, fine);
    CHECK(fine < 5e-4);
    CHECK(order(coarse, fine) == Approx(2).margin(0.2));
  }
}

TEST_CASE("twist model: a rod with natural curvature and twist is the exact helix without energy") {
  // curvature and torsion of a helix of radius r and pitch 2 pi c: r/(r^2+c^2), c/(r^2+c^2)
  const double r = 10, c = 4, w2 = r * r + c * c, w = std::sqrt(w2);
  double before = 0;
  for (int edges : {60, 120}) {
    RodMaterial spring{EA, EI, 2 * EI, GJ, {r / w2, 0}, c / w2};
    const double L = 2 * M_PI * w;  // one turn
    const SingleRod single(edges, L, spring, RodEnd::free, RodEnd::free);
    Model model = single.model();
    // six unknowns that fix it in space
    model.pin(0);
    model.fix(1, 1);
    model.fix(1, 2);
    model.fix_spin(0);
    finish(model);
    Linearisation system(model);
    State state = start_state(model, single.line());
    settle(system, state, 1e-7);
    CHECK(energies_of(model, state).total() < 1e-13 * EI);
    CHECK(system.residual() < 1e-9);
    // chord of the whole turn: the pitch
    const double pitch = (state.x.col(edges) - state.x.col(0)).norm();
    const double off = std::abs(pitch - 2 * M_PI * c) / L;
    CAPTURE(edges, pitch, off);
    if (before > 0) {
      CHECK(off < 1e-3);
      CHECK(order(before, off) == Approx(2).margin(0.2));
    }
    before = off;
  }
}

TEST_CASE("twist model: the localised helix of a long twisted rod", "[standard]") {
  // [Bergou 2008, section 8]; the envelope's closed form is [van der Heijden, Thompson 2000]
  const double L = 100, bending = 1.345, torsion = 0.789, slack = 3, turns = 27;
  const int edges = 400;
  const RodMaterial material{1e4, bending, bending, torsion, {0, 0}, 0};
  const SingleRod single(edges, L, material, RodEnd::clamped, RodEnd::clamped);
  const Model model = single.model();
  Linearisation system(model);
  // a coil of the right wave number in the middle, to choose the localised state among others
  const double M = 2 * bending * 0.49, k = M / (2 * bending);
  Eigen::Matrix3Xd x = single.line((L - slack) / L);
  for (int node = 1; node < edges; ++node) {
    const double s = L * (double(node) / edges - 0.5), a = 2.0 / std::cosh(s / 5);
    x(1, node) = a * std::cos(k * s) * (1 - 4 * s * s / (L * L));
    x(2, node) = a * std::sin(k * s) * (1 - 4 * s * s / (L * L));
  }
  State state = start_state(model, x);
  set_end_direction(model, 0, false, Eigen::Vector3d::UnitX(), state);
  set_end_direction(model, 0, true, Eigen::Vector3d::UnitX(), state);
  const double turn = 2 * M_PI * turns;
  for (int e = 0; e < edges; ++e)
    set_angle(model, state, model.rods[0].edges[std::size_t(e + 1)], turn * (e + 0.5) / edges);
  set_angle(model, state, model.rods[0].ghost_end, turn);
  settle(system, state, 1e-6);

  const double exact = 47.6515 * M_PI / 180, width = 4.59613;
  double widest = 0;
  int middle = 0;
  std::vector<double> phi(edges);
  for (int e = 0; e < edges; ++e) {
    const Eigen::Vector3d t = (state.x.col(e + 1) - state.x.col(e)).normalized();
    phi[e] = std::acos(std::min(1.0, t.x()));
    if (phi[e] > widest) widest = phi[e], middle = e;
  }
  CAPTURE(widest * 180 / M_PI, middle);
  CHECK(widest == Approx(exact).epsilon(0.01));
  // nothing constrains the coil along the rod: its middle is between edges, where phi is largest
  const double left = phi[std::size_t(middle - 1)], right = phi[std::size_t(middle + 1)];
  const double centre = middle + 0.5 * (left - right) / (left - 2 * widest + right);
  for (int e = middle - 80; e <= middle + 80; ++e) {
    const double s = (e - centre) * L / edges, f = std::tanh(s / width);
    const double envelope = (std::cos(phi[e]) - std::cos(exact)) / (1 - std::cos(exact));
    CHECK(std::abs(envelope - f * f) < 0.02);
  }
}

TEST_CASE("Euler: pinned and clamped rods buckle at pi^2 and 4 pi^2 EI/L^2, second order") {
  for (const RodEnd hold : {RodEnd::pinned, RodEnd::tangent, RodEnd::clamped})
    check_second_order([&](int edges) { return euler(edges, hold); }, 40,
                       (hold == RodEnd::pinned ? 1 : 4) * M_PI * M_PI, 1e-3, 0.15);
}

TEST_CASE("a clamped rod under twist buckles at 8.98682 EI/L, second order") {
  check_second_order(greenhill, 40, 8.98681891581813, 1e-3, 0.15);  // 2x, tan x = x
}

TEST_CASE("Michell's ring buckles at 2 pi sqrt(3) EI/GJ") {
  for (double ratio : {0.5, 0.75, 1.0, 2.0})
    check_second_order([&](int edges) { return michell(edges, ratio); }, 30, 1, 1e-2, 0.2);
}

TEST_CASE("joint shear: two rigid crossing rods turn by moment over stiffness") {
  // stiff rods, one fixed, the other rotated about the joint by a couple at its ends
  const RodMaterial stiff{1e6, 1e7, 1e7, 1e7, {0, 0}, 0};
  ModelRod a{{0, 5, 1, 6, 2}, {0, 5, 10, 15, 20}, stiff, {}, {0, 0, 1, 0, 0}};
  ModelRod b{{3, 7, 1, 8, 4}, {0, 5, 10, 15, 20}, stiff,       {},
             {0, 0, 1, 0, 0}, RodEnd::free,       RodEnd::free};
  Model model = build_model(9, {a, b}, RodModel::twist).value();
  const double stiffness = 40, couple = 2;  // N mm/rad, N mm
  add_joint_shear(model, {0, 1, 1, 1}, {stiffness});
  model.loads.push_back({3, {couple / 20, 0, 0}});
  model.loads.push_back({4, {-couple / 20, 0, 0}});
  for (int node : {3, 4}) model.fix(node, 2);  // in the plane
  finish(model);
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, 9);
  x.row(0) << -10, 0, 10, 0, 0, -5, 5, 0, 0;
  x.row(1) << 0, 0, 0, -10, 10, 0, 0, -5, 5;
  Linearisation system(model);
  State state = start_state(model, x);
  settle(system, state, 1e-7);
  const Eigen::Vector3d along = state.x.col(4) - state.x.col(3);
  const double turn = std::atan2(std::abs(along.x()), along.y());
  CHECK(turn == Approx(couple * std::cos(turn) / stiffness).epsilon(1e-3));
}
