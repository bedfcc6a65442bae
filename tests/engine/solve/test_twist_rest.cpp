// Rods at rest with known shapes: the elastica, a cantilever, a helix, the localised helix.
#include "engine/elastic/rod_frame.h"
#include "tests/engine/solve/rod_cases.h"

using namespace gridshell;

namespace {

constexpr double EI = 16.95832, EA = 4205.672, GJ = 12.667659, length = 252;
const RodMaterial wire{10 * EA, EI, EI, GJ, {0, 0}, 0};

/// Height over L of a pinned rod whose ends come together; starts with its edges
/// turned at random.
double elastica_height(int edges, double shortening) {
  const SingleRod single(edges, length, wire, RodEnd::pinned, RodEnd::pinned);
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
  const SingleRod single(edges, length, wire, RodEnd::clamped, RodEnd::free);
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

/// The same by the elastica's first integral: theta'' = -a cos theta, theta(0) = 0, theta'(1) = 0,
/// shooting for theta'(0) with Runge-Kutta steps.
Eigen::Vector2d cantilever_exact(double a) {
  const auto shoot = [&](double kappa) {
    const int n = 4000;
    const double h = 1.0 / n;
    using Y = Eigen::Vector4d;  // theta, theta', x, y
    const auto slope = [&](const Y& y) {
      return Y(y[1], -a * std::cos(y[0]), std::cos(y[0]), std::sin(y[0]));
    };
    Y y(0, kappa, 0, 0);
    for (int k = 0; k < n; ++k) {
      const Y k1 = slope(y), k2 = slope(y + h / 2 * k1), k3 = slope(y + h / 2 * k2),
              k4 = slope(y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return y;
  };
  double low = 0, high = a + 1;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (shoot(middle)[1] > 0 ? high : low) = middle;
  }
  return shoot(high).tail<2>();
}

}  // namespace

TEST_CASE("twist rung: the pinned elastica from random edge angles, second order") {
  for (double shortening : {0.1, 0.5}) {
    const double m = shortening == 0.1 ? 0.09871763 : 0.46400983;
    const double exact = std::sqrt(m) / std::comp_ellint_1(std::sqrt(m));
    const double coarse = std::abs(elastica_height(26, shortening) - exact),
                 fine = std::abs(elastica_height(52, shortening) - exact);
    CAPTURE(coarse, fine);
    CHECK(fine < 5e-4);
    CHECK(order(coarse, fine) == Approx(2).margin(0.15));
  }
}

TEST_CASE("twist rung: a cantilever under an end load, large deflection, second order") {
  for (double load : {1.0, 5.0}) {
    const Eigen::Vector2d exact = cantilever_exact(load);
    // the table of Bisshopp and Drucker [1945]: deflection 0.30172 L at 1, 0.71379 L at 5
    CHECK(exact.y() == Approx(load == 1 ? 0.30172 : 0.71379).margin(1e-5));
    const double coarse = (cantilever(25, load) - exact).norm(),
                 fine = (cantilever(50, load) - exact).norm();
    CAPTURE(load, coarse, fine);
    CHECK(fine < 5e-4);
    CHECK(order(coarse, fine) == Approx(2).margin(0.2));
  }
}

TEST_CASE("twist rung: a rod curved and twisted at rest is the exact helix without energy") {
  // curvature and torsion of a helix of radius r and pitch 2 pi c: r/(r^2+c^2), c/(r^2+c^2)
  const double r = 10, c = 4, w2 = r * r + c * c, w = std::sqrt(w2);
  double before = 0;
  for (int edges : {60, 120}) {
    RodMaterial spring{EA, EI, 2 * EI, GJ, {r / w2, 0}, c / w2};
    const double L = 2 * M_PI * w;  // one turn
    const SingleRod single(edges, L, spring, RodEnd::free, RodEnd::free);
    Model model = single.model();
    // six unknowns that hold it in space
    model.pin(0);
    model.hold(1, 1);
    model.hold(1, 2);
    model.hold_spin(0);
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

TEST_CASE("twist rung: the localised helix of a long twisted rod", "[standard]") {
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
  // nothing holds the coil along the rod: its middle lies between edges, where phi is widest
  const double left = phi[std::size_t(middle - 1)], right = phi[std::size_t(middle + 1)];
  const double centre = middle + 0.5 * (left - right) / (left - 2 * widest + right);
  for (int e = middle - 80; e <= middle + 80; ++e) {
    const double s = (e - centre) * L / edges, f = std::tanh(s / width);
    const double envelope = (std::cos(phi[e]) - std::cos(exact)) / (1 - std::cos(exact));
    CHECK(std::abs(envelope - f * f) < 0.02);
  }
}
