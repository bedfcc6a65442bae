// The lowest modes compared with a dense decomposition, and frequencies with closed forms.
#include "engine/solve/eigenmodes.h"

#include <cmath>

#include "engine/core/dense.h"
#include "engine/elastic/model.h"
#include "engine/solve/dynamics.h"
#include "tests/engine/elastic/bent_dome.h"
#include "tests/engine/solve/crossing_rods.h"
#include "tests/engine/solve/rod_cases.h"
#include "tests/engine/solve/single_rod.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

constexpr double L = 200, per_mm = 6450e-12 * M_PI * 0.254 * 0.254 / 4;  // mm, t/mm
const RodSection section = circular_section(0.254, 83);
/// (2 pi f)^2 of a pinned beam's first mode
const double first = std::pow(M_PI / L, 4) * section.EI / per_mm;

/// The lowest eigenvalues (2 pi f)^2 of a state that is an equilibrium or near one, 1/s^2.
Eigen::VectorXd lambdas(Linearisation& system, const State& state, int count) {
  const Model& model = system.model();
  const Inertia inertia = system.at(state, false);
  const auto found = value_of(softest_modes(system, value_of(lumped_mass(model, {per_mm})), count,
                                            inertia.negative_pivots, unwatched));
  CHECK(int(found.values.size()) == count);
  for (const double residual : found.residuals) CHECK(residual < 1e-5);
  return found.values;
}

/// Modes of rods on 32 and 64 edges, extrapolated.
template <class OnMesh>
Eigen::VectorXd extrapolated(const OnMesh& on) {
  return (4 * on(64) - on(32)) / 3;
}

/// A pinned rod, stretched by a strain.
Eigen::VectorXd pinned_beam(double strain, int count) {
  return extrapolated([&](int edges) {
    const Model model = build_model(single_rod(edges, L), section).value();
    Linearisation system(model);
    return lambdas(system, start_state(model, straight(model, 1 + strain)), count);
  });
}

/// (2 pi f)^2 of the n-th mode of a pinned beam under the axial force of a strain, over first.
double exact(int n, double strain) {
  const double force = section.EA * strain * L * L / (M_PI * M_PI * section.EI);
  return n * n * (n * n + force);
}

}  // namespace

TEST_CASE("lowest modes: those of a dense decomposition, every copy of equal ones among them") {
  // two equal rods under tension: all modes come in pairs or fours
  const Model model = build_model(crossing_rods(4), section).value();
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, model.nodes);
  x.topRows(2) = 1.0005 * model.flat;
  const State state = start_state(model, x);
  const Eigen::Matrix3Xd mass = value_of(lumped_mass(model, {per_mm}));
  Linearisation system(model);
  REQUIRE(system.at(state, false).positive_definite());
  Eigen::VectorXd of_free(model.dof());
  for (int k = 0; k < model.dof(); ++k) of_free[k] = mass(k % 3, model.free_columns[k / 3]);
  const Eigen::VectorXd exact =
      eigen_pairs(dense(model, system.assembly().hessian), of_free.asDiagonal().toDenseMatrix())
          .values;
  for (const int count : {1, 2, 5, 12, 24}) {
    const auto found = value_of(softest_modes(system, mass, count, 0, unwatched));
    REQUIRE(found.values.size() == count);
    for (Eigen::Index k = 0; k < count; ++k) {
      CAPTURE(count, k);
      CHECK(found.values[k] == Approx(exact[k]).epsilon(1e-8));
      CHECK(found.residuals[std::size_t(k)] < 1e-6);
      for (Eigen::Index other = 0; other <= k; ++other)
        CHECK(product(found.shapes[std::size_t(k)],
                      mass.cwiseProduct(found.shapes[std::size_t(other)])) ==
              Approx(k == other).margin(1e-6));
    }
  }
  // no more than there are
  CHECK(value_of(softest_modes(system, mass, 1000, 0, unwatched)).values.size() == model.dof());
}

TEST_CASE("frequencies: a pinned beam, in both planes") {
  const Eigen::VectorXd found = pinned_beam(0, 8) / first;
  for (int n = 1; n <= 4; ++n)
    for (const int copy : {2 * n - 2, 2 * n - 1}) {
      CAPTURE(n, copy);
      CHECK(found[copy] == Approx(std::pow(n, 4)).epsilon(1e-4));
    }
}

TEST_CASE("frequencies: under an axial force their squares grow evenly, and fall to Euler's load") {
  const double euler = M_PI * M_PI * section.EI / (L * L) / section.EA;
  for (const double load : {-0.99, -0.5, 0.5, 10.0}) {
    const Eigen::VectorXd found = pinned_beam(load * euler, 4) / first;
    CAPTURE(load);
    CHECK(found[0] == Approx(1 + load).epsilon(1e-4).margin(1e-5));
    CHECK(found[2] == Approx(exact(2, load * euler)).epsilon(1e-4));
  }
  // above it the first is no vibration: that many eigenvalues are below zero
  const Eigen::VectorXd beyond = pinned_beam(-2 * euler, 4) / first;
  CHECK(beyond[0] == Approx(-1).epsilon(1e-4));
  CHECK(beyond[1] == Approx(-1).epsilon(1e-4));
  CHECK(beyond[2] == Approx(8).epsilon(1e-4));
}

TEST_CASE("frequencies: a string under tension, its stiffness a small part") {
  constexpr double strain = 5e-4;
  const Eigen::VectorXd found = pinned_beam(strain, 6) / first;
  for (int n = 1; n <= 3; ++n)
    // the string is longer, and lighter over its length, by the strain
    CHECK(found[2 * n - 2] == Approx(exact(n, strain)).epsilon(2 * strain));
}

TEST_CASE("frequencies: a clamped beam and a cantilever") {
  const RodMaterial material = circular_material(0.254, 83, 31);
  const auto beam = [&](RodEnd end, int count) {
    return Eigen::VectorXd(extrapolated([&](int edges) {
                             const SingleRod rod(edges, L, material, RodEnd::clamped, end);
                             const Model model = rod.model();
                             Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, model.columns());
                             x.leftCols(edges + 1) = rod.line();
                             for (int k = edges + 1; k < model.nodes; ++k)
                               x.col(k).x() = k == edges + 1 ? -L / edges : L + L / edges;
                             Linearisation system(model);
                             return lambdas(system, start_state(model, x), count);
                           }) /
                           (section.EI / per_mm / std::pow(L, 4)))
        .array()
        .sqrt()
        .sqrt()
        .matrix()
        .eval();
  };
  const Eigen::VectorXd both = beam(RodEnd::clamped, 4);
  CHECK(both[0] == Approx(4.73004074).epsilon(1e-5));
  CHECK(both[1] == Approx(4.73004074).epsilon(1e-5));
  CHECK(both[2] == Approx(7.85320462).epsilon(3e-5));
  const Eigen::VectorXd one = beam(RodEnd::free, 4);
  CHECK(one[0] == Approx(1.87510407).epsilon(1e-5));
  CHECK(one[2] == Approx(4.69409113).epsilon(3e-5));
}

TEST_CASE("frequencies: a shallow arch that a beam buckled to") {
  // the n-th mode of the arch without a rise of its own: n^2 (n^2 - 1), out of its plane too, where
  // the first is a turn about the line between its hinges
  const Eigen::VectorXd found =
      extrapolated([&](int edges) {
        const Model model = build_model(single_rod(edges, L), section).value();
        Linearisation system(model);
        constexpr double shorter = 2e-4;
        State state =
            start_state(model, straight(model, 1 - shorter, 2 / M_PI * std::sqrt(shorter) * L));
        settle(system, state);
        system.bear_neutral_directions();
        return lambdas(system, state, 5);
      }) /
      first;
  CHECK(std::abs(found[0]) < 1e-3);
  CHECK(found[1] == Approx(12).epsilon(1e-3));
  CHECK(found[2] == Approx(12).epsilon(1e-3));
  CHECK(found[3] == Approx(72).epsilon(1e-3));
}

TEST_CASE("lowest modes: stopped when cancelled") {
  const Model model = build_model(single_rod(16, L), section).value();
  Linearisation system(model);
  system.at(start_state(model, straight(model)), false);
  const Eigen::Matrix3Xd mass = value_of(lumped_mass(model, {per_mm}));
  check_stops([&](const Watch& watch) { return softest_modes(system, mass, 3, 0, watch); });
}

TEST_CASE("the lowest stiffness is found from a mode of another symmetry") {
  const RodMesh mesh = single_rod(32, L);
  const Model model = build_model(mesh, section).value();
  Linearisation system(model);
  REQUIRE(system.at(start_state(model, straight(model, 1.0001)), false).positive_definite());
  const Eigen::VectorXd length = lumped(mesh, {1.0});
  Eigen::Matrix3Xd any;
  const double lowest = lowest_eigenvalue(system, length, any, unwatched, 1e-7);
  // the second mode has no part along the first
  Eigen::Matrix3Xd second = Eigen::Matrix3Xd::Zero(3, model.columns());
  for (int k = 0; k < model.nodes; ++k)
    second(2, k) = std::sin(2 * M_PI * (model.flat(0, k) / L + 0.5));
  CHECK(lowest_eigenvalue(system, length, second, unwatched, 0.02) == Approx(lowest).epsilon(0.05));
  Watch watch;
  watch.cancel();
  CHECK(std::isnan(lowest_eigenvalue(system, length, any, watch, 0.02)));
}
