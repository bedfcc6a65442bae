// Rods with closed-form solutions: each on three meshes, which must converge with second order, and
// extrapolated from the finer two with a smaller error.
#include <functional>
#include <string>

#include "engine/elastic/model.h"
#include "tests/engine/solve/elastica.h"
#include "tests/engine/solve/rod_cases.h"

using namespace gridshell;

namespace {

constexpr double length = 252, EI = 16.95832, EA = 4205.672, GJ = 12.667659;
const RodMaterial wire{EA, EI, EI, GJ, {0, 0}, 0};

/// The load factor at which the equilibrium of `model` reached from `x` loses its stability.
double critical_load(Model model, const State& from, double low, double high) {
  finish(model);
  Linearisation system(model);
  return critical(low, high, [&](double factor) {
    State state = from;
    system.outside.load = factor;
    const NewtonReport report = newton(system, state, {.tolerance_mm = 1e-9});
    REQUIRE(report.outcome == Outcome::reached);
    return system.at(state, false).positive_definite();
  });
}

/// The end load at which a strip that is clamped on edge turns over, over sqrt(EI GJ)/L^2
/// [Prandtl 1899, Michell 1899].
double lateral(int edges) {
  constexpr double weak = 10, across = 1e6, torsion = 8;
  const SingleRod single(edges, length, {1e6, weak, across, torsion, {0, 0}, 0}, RodEnd::clamped,
                         RodEnd::free);
  Model model = single.model();
  model.loads.push_back({edges, {0, 0, -std::sqrt(weak * torsion) / (length * length)}});
  return critical_load(model, start_state(model, single.line()), 2, 6);
}

constexpr double cable_weight = 1e-3, cable_EA = 100, cable_span = 0.9 * length;

/// The sag of a cable without bending stiffness to speak of, mm.
double cable(int edges) {
  constexpr double soft = 1e-4;
  const SingleRod single(edges, length, {cable_EA, soft, soft, soft, {0, 0}, 0}, RodEnd::pinned,
                         RodEnd::pinned);
  Model model = single.model();
  for (int k = 1; k < edges; ++k)
    model.loads.push_back({k, {0, 0, -cable_weight * length / edges}});
  Linearisation system(model);
  State state = start_state(model, single.line(cable_span / length, -0.2 * length));
  settle(system, state, 1e-8);
  return -state.x(2, edges / 2);
}

/// The elastic catenary [Irvine 1981].
double catenary() {
  const double V = cable_weight * length / 2;
  const auto span = [&](double H) {
    return H * length / cable_EA + 2 * H / cable_weight * std::asinh(V / H);
  };
  const double H = zero_of([&](double of) { return span(of) - cable_span; }, 1e-3 * V, 1e3 * V);
  return V * length / (4 * cable_EA) + H / cable_weight * (std::hypot(1, V / H) - 1);
}

constexpr double coil = 10, rise = 4;  // a helix of this radius, and of pitch 2 pi times this
constexpr int turns = 2;

/// How much longer a helical spring is under a force along the line of its ends, mm/N.
double spring(int edges) {
  const double w2 = coil * coil + rise * rise;
  const SingleRod single(edges, turns * 2 * M_PI * std::sqrt(w2),
                         {EA / 10, EI, EI, GJ, {coil / w2, 0}, rise / w2}, RodEnd::free,
                         RodEnd::free);
  Model model = single.model();
  // six unknowns that fix it in space; the force passes through the first
  model.pin(0);
  model.fix(1, 1);
  model.fix(1, 2);
  model.fix_spin(0);
  finish(model);
  const auto chord = [&](const State& state) -> Eigen::Vector3d {
    return state.x.col(edges) - state.x.col(0);
  };
  // wound up from a straight rod bit by bit
  State rest = start_state(model, single.line());
  auto& bends = std::get<std::vector<Pair<SectionBending>>>(model.pairs);
  auto& torsions = std::get<std::vector<Pair<Torsion>>>(model.pairs);
  const auto wound_bends = bends;
  const auto wound_torsions = torsions;
  for (const double fraction : {0.25, 0.5, 0.75, 1.0}) {
    for (std::size_t k = 0; k < bends.size(); ++k) {
      bends[k].law.bend.rest = fraction * wound_bends[k].law.bend.rest;
      torsions[k].law.rest = fraction * wound_torsions[k].law.rest;
    }
    Linearisation system(model);
    settle(system, rest, 1e-8);
  }
  constexpr double force = 1e-5;
  double longer = 0;
  for (const double sign : {1.0, -1.0}) {
    model.loads = {{edges, sign * force * chord(rest).normalized()}};
    Linearisation system(model);
    State state = rest;
    settle(system, state, 1e-8);
    longer += sign * chord(state).norm();
  }
  return longer / (2 * force);
}

/// By Castigliano: at an angle phi from an end the force turns the wire by R (1 - cos phi) cos
/// alpha, and its whole moment squared is 2 R^2 (1 - cos phi).
double spring_exact() {
  const double w2 = coil * coil + rise * rise, cos2 = coil * coil / w2;
  return coil * coil * turns * 2 * M_PI * std::sqrt(w2) * (1.5 * cos2 / GJ + (2 - 1.5 * cos2) / EI);
}

/// The load on the crown of an arch of 215 degrees, clamped at one foot and pinned at the other, at
/// which it snaps, over EI/R^2.
double arch(int edges) {
  constexpr double R = 100, half = 215.0 / 360 * M_PI;
  ModelRod rod{{},
               {},
               {EA, EI, EI, GJ, {0, -1 / R}, 0},
               {},
               {},
               RodEnd::clamped,
               RodEnd::pinned,
               {-std::sin(half), 0, std::cos(half)}};
  Eigen::Matrix3Xd x(3, edges + 1);
  for (int k = 0; k <= edges; ++k) {
    const double angle = half * (2.0 * k / edges - 1);
    rod.nodes.push_back(k);
    rod.position.push_back(2 * R * half * k / edges);
    x.col(k) << R * std::sin(angle), 0, R * std::cos(angle);
  }
  Model model = build_model(edges + 1, {rod}, RodModel::twist).value();
  for (int k = 0; k <= edges; ++k) model.fix(k, 1);
  finish(model);
  State state = start_state(model, x);
  set_end_direction(model, 0, false, {std::cos(half), 0, std::sin(half)}, state);
  Linearisation system(model);
  const Constraint crown{edges / 2, Eigen::Vector3d::UnitZ()};
  system.constrain({crown});
  constexpr double step = 0.01 * R;
  double before = 0, here = 0;
  Eigen::Matrix3Xd last = state.x;
  for (int k = 1; k < 160; ++k) {
    // the prediction continues the last step
    const Eigen::Matrix3Xd at = std::exchange(last, state.x);
    Eigen::Matrix3Xd on = 2 * state.x - at;
    on(2, crown.node) = R - k * step;
    move_to(model, on, state);
    const NewtonReport report = newton(system, state, {.tolerance_mm = 1e-6});
    REQUIRE(report.outcome == Outcome::reached);
    system.gradient_at(state);
    const double next = -system.reaction(crown).z() * R * R / EI;
    // the top of the parabola through three
    if (k > 2 && next < here)
      return here + std::pow(next - before, 2) / (8 * (2 * here - next - before));
    before = std::exchange(here, next);
  }
  FAIL("the load only grows");
  return 0;
}

struct ClosedForm {
  std::string name;
  double exact;
  std::function<double(int)> found;  ///< the value on a mesh of so many edges
  int edges;                         ///< of the coarsest mesh
  double left;                       ///< largest relative error after extrapolation
};

}  // namespace

TEST_CASE("closed forms of rods: at second order, and extrapolated", "[standard]") {
  const std::vector<ClosedForm> cases{{"lateral buckling of a strip", 4.01260, lateral, 32, 1e-4},
                                      {"cable", catenary(), cable, 32, 1e-4},
                                      {"helical spring", spring_exact(), spring, 80, 1e-4},
                                      // DaDeppo and Schmidt [1975], three digits
                                      {"snap of a circular arch", 8.97, arch, 80, 1e-3}};
  for (const ClosedForm& one : cases) {
    INFO(one.name);
    const double coarse = one.found(one.edges), fine = one.found(2 * one.edges),
                 finest = one.found(4 * one.edges), extrapolated = (4 * finest - fine) / 3;
    CAPTURE(one.name, one.exact, coarse, fine, finest, extrapolated);
    CHECK(order(coarse - fine, fine - finest) == Approx(2).margin(0.1));
    CHECK(std::abs(extrapolated / one.exact - 1) < one.left);
  }
}
