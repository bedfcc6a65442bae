#include <catch2/catch.hpp>

#include "engine/core/dense.h"
#include "engine/elastic/model.h"
#include "engine/solve/block_factor.h"
#include "engine/solve/newton.h"
#include "engine/study/cholmod_solver.h"
#include "tests/engine/elastic/bent_dome.h"

using namespace gridshell;

namespace {

struct System : BentDome {
  Assembly assembly;

  System(double radius, int rods, int edges) : BentDome(bent_dome(radius, rods, edges)) {
    assemble_hessian(model, state, {}, {}, assembly);
  }
};

double residual(const System& system, const LinearSolver& solver, double shift) {
  Eigen::Matrix3Xd b = system.assembly.gradient;
  for (int k = 0; k < system.model.nodes; ++k)
    if (system.model.pinned(k)) b.col(k).setZero();
  Eigen::Matrix3Xd x = b, y;
  solver.solve(x);
  multiply(system.model, system.assembly.hessian, x, y);
  y += shift * x;
  for (int k = 0; k < system.model.nodes; ++k)
    if (system.model.pinned(k)) y.col(k).setZero();
  return (y - b).norm() / b.norm();
}

}  // namespace

TEST_CASE("factorisations: solve, and count negative pivots as dense eigenvalues do") {
  const System system(70, 6, 2);
  const Eigen::MatrixXd full = dense(system.model, system.assembly.hessian);
  CHECK((full - full.transpose()).norm() <= 1e-12 * full.norm());
  const Eigen::VectorXd own = eigenvalues(full);

  const auto solvers = {make_block_cholesky(system.model), make_cholmod(system.model),
                        make_cholmod(system.model, {.supernodal = false, .own_ordering = false})};
  for (double shift : {0.0, 0.3, 5.0, 500.0}) {
    const int negative = int((own.array() < -shift).count());
    for (const auto& solver : solvers) {
      const Inertia inertia = solver->factor(system.assembly.hessian, shift);
      REQUIRE(inertia.usable);
      CHECK(inertia.negative_pivots == negative);
      CHECK(residual(system, *solver, shift) < 1e-8);
    }
  }
  CHECK(own[0] < 0);  // the counts above were not all zero
}

TEST_CASE("a matrix of rank one that joins all columns is solved with, and counted") {
  System system(70, 6, 2);
  BlockHessian& h = system.assembly.hessian;
  const Eigen::MatrixXd own_blocks = dense(system.model, h);
  const Eigen::VectorXd plain = eigenvalues(own_blocks);
  int changed = 0;
  for (const double size : {1.0, 100.0}) {
    h.rank_one = size * Eigen::Matrix3Xd::Random(3, system.model.columns());
    for (int k = 0; k < system.model.nodes; ++k)
      if (system.model.pinned(k)) h.rank_one.col(k).setZero();
    Eigen::VectorXd c(own_blocks.rows());
    for (int k = 0; k < system.model.free(); ++k)
      c.segment<3>(3 * k) = h.rank_one.col(system.model.free_columns[std::size_t(k)]);
    const Eigen::MatrixXd full = own_blocks + c * c.transpose();
    CHECK((dense(system.model, h) - full).norm() < 1e-12 * full.norm());
    const Eigen::VectorXd own = eigenvalues(full);
    const auto solver = make_linear_solver(system.model);
    for (const double shift : {0.0, 0.3}) {
      const int negative = int((own.array() < -shift).count());
      changed += negative != int((plain.array() < -shift).count());
      const Inertia inertia = solver->factor(h, shift);
      REQUIRE(inertia.usable);
      CHECK(inertia.negative_pivots == negative);
      CHECK(residual(system, *solver, shift) < 1e-8);
    }
  }
  CHECK(changed > 0);
}

TEST_CASE("factorisations: what one left is not in the next, on long chains") {
  const System system(70, 6, 12);
  const auto solver = make_block_cholesky(system.model), other = make_cholmod(system.model);
  for (double shift : {0.0, 500.0, 0.3, 500.0}) {
    const Inertia inertia = solver->factor(system.assembly.hessian, shift);
    REQUIRE(inertia.usable);
    CHECK(inertia.negative_pivots == other->factor(system.assembly.hessian, shift).negative_pivots);
    CHECK(residual(system, *solver, shift) < 1e-8);
  }
}

TEST_CASE("factorisations: large ones have the same bits on any number of threads") {
  const System system(486, 48, 4);
  REQUIRE(system.model.dof() > 30000);
  const auto alone = make_block_cholesky(system.model), other = make_cholmod(system.model);
  for (int threads : {2, 3, 8}) {
    Team team(threads);
    const auto solver = make_block_cholesky(system.model);
    solver->team = &team;
    for (double shift : {0.0, 500.0}) {
      const Inertia one = alone->factor(system.assembly.hessian, shift),
                    all = solver->factor(system.assembly.hessian, shift);
      REQUIRE(all.usable);
      CHECK(all.negative_pivots == one.negative_pivots);
      CHECK(all.negative_pivots == other->factor(system.assembly.hessian, shift).negative_pivots);
      CHECK(all.smallest_pivot == one.smallest_pivot);
      CHECK(all.largest_pivot == one.largest_pivot);
      CHECK(residual(system, *solver, shift) < 1e-8);
      for (int again = 0; again < 20; ++again) {
        Eigen::Matrix3Xd x = system.assembly.gradient, y = x;
        alone->solve(x);
        solver->solve(y);
        REQUIRE(x == y);
      }
    }
    // factorisations that stop at the first negative pivot report the same number, too
    solver->most_negative = alone->most_negative = 0;
    CHECK(solver->factor(system.assembly.hessian, 0).negative_pivots ==
          alone->factor(system.assembly.hessian, 0).negative_pivots);
    alone->most_negative = std::numeric_limits<int>::max();
  }
}

TEST_CASE("factorisations: two systems in one memory take turns, each with its own solution") {
  const BentDome coarse = bent_dome(70, 6, 2), fine = bent_dome(70, 6, 4);
  Linearisation alone(fine.model), a(coarse.model), b(fine.model);
  const auto numbers = std::make_shared<FactorNumbers>();
  a.share(numbers);
  b.share(numbers);
  b.at(fine.state, false, 0.3);
  a.at(coarse.state, false, 0.3);
  CHECK(numbers->below.size() >= 100);
  alone.at(fine.state, false, 0.3);
  Eigen::Matrix3Xd x = alone.assembly().gradient, y = x;
  alone.solve(x);
  b.solve(y);
  CHECK(x == y);
  // the factor is computed again once, which is counted
  b.solve(y);
  CHECK(b.effort().factorizations == 2);
  CHECK(alone.effort().factorizations == 1);
}

TEST_CASE("factorisations: a singular or infinite matrix is not usable") {
  System system(70, 6, 2);
  const auto solver = make_block_cholesky(system.model);
  for (double bad : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    for (auto& block : system.assembly.hessian.diagonal) block.matrix().setConstant(bad);
    for (auto& block : system.assembly.hessian.pair) block.matrix().setConstant(bad);
    CHECK_FALSE(solver->factor(system.assembly.hessian, 0).usable);
  }
}

TEST_CASE("ordering: a permutation, with about the fill of CHOLMOD's nested dissection") {
  for (int edges : {2, 4, 8}) {
    const System system(126, 12, edges);
    const auto graph = hessian_graph(system.model);
    std::vector<int> order = nested_dissection(system.model, graph);
    std::sort(order.begin(), order.end());
    REQUIRE(int(order.size()) == system.model.free());
    for (int k = 0; k < int(order.size()); ++k) REQUIRE(order[k] == k);
    const auto own = make_cholmod(system.model, {.supernodal = false, .own_ordering = true});
    const auto metis = make_cholmod(system.model, {.supernodal = false, .own_ordering = false});
    own->factor(system.assembly.hessian, 100);
    metis->factor(system.assembly.hessian, 100);
    CHECK(own->blocks() <= 1.05 * metis->blocks());
  }
}

TEST_CASE("a solver that gave its memory back has no factor, and one again after the next") {
  const System system(70, 6, 2);
  const auto solver = make_linear_solver(system.model);
  CHECK_FALSE(solver->has_factor());
  REQUIRE(solver->factor(system.assembly.hessian, 500).usable);
  CHECK(solver->has_factor());
  solver->free_memory();
  CHECK_FALSE(solver->has_factor());
  CHECK(solver->blocks() == 0);
  Eigen::Matrix3Xd b = system.assembly.gradient;
  solver->solve(b);
  CHECK(b.isZero(0));
  REQUIRE(solver->factor(system.assembly.hessian, 500).usable);
  CHECK(residual(system, *solver, 500) < 1e-8);
}
