#include <catch2/catch.hpp>

#include "engine/core/dense.h"
#include "engine/elastic/model.h"
#include "engine/solve/equilibrium.h"
#include "tests/engine/elastic/bent_dome.h"

using namespace gridshell;

namespace {

BentDome unstrained_dome() {
  BentDome dome = bent_dome(70, 6, 2);
  dome.state.force.setZero();
  return dome;
}

Eigen::MatrixXd dense_hessian(const Model& model, const State& state) {
  Assembly assembly;
  assemble_hessian(model, state, {}, {}, assembly);
  return dense(model, assembly.hessian);
}

/// The bordered matrix [K -B; B^T 0].
Eigen::MatrixXd bordered(const Model& model, const Eigen::MatrixXd& K, const Constraint& held) {
  const Eigen::Index n = K.rows(), m = held.directions.cols();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n + m, n + m);
  all.topLeftCorner(n, n) = K;
  all.block(3 * model.free_index[held.node], n, 3, m) = -held.directions;
  all.block(n, 3 * model.free_index[held.node], m, 3) = held.directions.transpose();
  return all;
}

Constraint pushed(int directions) {
  Constraint held{7, Eigen::Matrix3Xd::Identity(3, directions)};
  if (directions == 1) held.directions << 0.48, -0.6, 0.64;
  return held;
}

}  // namespace

TEST_CASE(
    "a prescribed joint: corrections, tangent, stiffness and inertia of the bordered system") {
  const BentDome shell = unstrained_dome();
  const Model& model = shell.model;
  const Eigen::MatrixXd K = dense_hessian(model, shell.state);
  for (const int directions : {1, 3}) {
    const Constraint held = pushed(directions);
    const Eigen::Index n = K.rows(), m = directions;
    const Eigen::MatrixXd whole = bordered(model, K, held);
    Linearisation system(model);
    system.constrain({held});
    const Inertia inertia = system.at(shell.state, false);

    Eigen::MatrixXd symmetric = whole;
    symmetric.topRightCorner(n, m) *= -1;
    const Eigen::VectorXd own = eigenvalues(symmetric);
    REQUIRE(inertia.usable);
    CHECK(inertia.negative_pivots == int((own.array() < 0).count()) - directions);

    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + m);
    for (int k = 0; k < n; ++k)
      right[k] = -system.assembly().gradient(k % 3, model.free_columns[k / 3]);
    const Eigen::VectorXd expected = solution(whole, right);
    Eigen::Matrix3Xd dx;
    system.correction(dx);
    for (int k = 0; k < n; ++k)
      REQUIRE(dx(k % 3, model.free_columns[k / 3]) ==
              Approx(expected[k]).margin(1e-8 * expected.head(n).cwiseAbs().maxCoeff()));
    CHECK((held.directions.transpose() * dx.col(held.node)).norm() <
          1e-8 * expected.head(n).cwiseAbs().maxCoeff());

    // unit speed along the first direction: B^T dx = e, and the force that grows with it
    right.setZero();
    right[n] = 1;
    const Eigen::VectorXd moving = solution(whole, right);
    Eigen::Matrix3Xd pinned = Eigen::Matrix3Xd::Zero(3, model.nodes), velocity;
    pinned.col(held.node) = held.directions.col(0);
    system.tangent(pinned, {.load = 0}, shell.state, velocity);
    for (int k = 0; k < n; ++k)
      REQUIRE(velocity(k % 3, model.free_columns[k / 3]) ==
              Approx(moving[k]).margin(1e-8 * moving.head(n).cwiseAbs().maxCoeff()));
    CHECK(system.constraint_stiffness()(0, 0) ==
          Approx(moving[n]).margin(1e-7 * std::abs(moving[n])));
  }
}

TEST_CASE("a joint prescribed along a direction that K does not resist is found stable") {
  // at a limit point K is singular along the push; shifted there, it has one negative pivot past it
  const BentDome shell = unstrained_dome();
  Linearisation free(shell.model);
  State rest = shell.state;
  REQUIRE(minimise(free, rest, {}, unwatched).outcome == Outcome::reached);
  const Eigen::MatrixXd K = dense_hessian(shell.model, rest);
  const EigenPairs own = eigen_pairs(K);
  const double beyond = -0.5 * (own.values[0] + own.values[1]);
  REQUIRE(free.at(rest, false, beyond).negative_pivots == 1);
  int strongest = 0;
  own.vectors.col(0).cwiseAbs().maxCoeff(&strongest);
  Constraint held{shell.model.free_columns[strongest / 3], Eigen::Matrix3Xd::Zero(3, 1)};
  held.directions(strongest % 3, 0) = 1;
  Linearisation system(shell.model);
  system.constrain({held});
  const Inertia inertia = system.at(rest, false, beyond);
  Eigen::MatrixXd shifted = K;
  shifted.diagonal().array() += beyond;
  Eigen::MatrixXd symmetric = bordered(shell.model, shifted, held);
  symmetric.topRightCorner(K.rows(), 1) *= -1;
  const Eigen::VectorXd pivots = eigenvalues(symmetric);
  CHECK(inertia.negative_pivots == int((pivots.array() < 0).count()) - 1);
  CHECK(inertia.negative_pivots == 0);
}
