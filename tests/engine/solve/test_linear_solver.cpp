#include <catch2/catch.hpp>

#include <Eigen/Eigenvalues>

#include "engine/elastic/assembly.h"
#include "engine/elastic/shell_rods.h"
#include "engine/solve/linear_solver.h"

using namespace gridshell;

namespace {

struct System {
  Model model;
  Assembly assembly;
};

System bent(double radius, int rods, int edges) {
  const auto placement = rods % 2 ? Placement::on_axis : Placement::half;
  const Footprint net = circular_footprint(radius, rods, 20.0, placement).value();
  System system{build_model(mesh_rods(net, edges), circular_section(0.254, 83)).value(), {}};
  Eigen::Matrix3Xd x(3, system.model.nodes);
  for (int k = 0; k < system.model.nodes; ++k) {
    const Eigen::Vector2d p = system.model.flat.col(k);
    x.col(k) << 0.99 * p, 15 * (1 - p.squaredNorm() / (radius * radius)) + 1e-3 * p.x() * p.y();
  }
  assemble_hessian(system.model, start_state(system.model, x), {}, {}, system.assembly);
  return system;
}

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
  const System system = bent(70, 6, 2);
  const int n = system.model.dof();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  Eigen::Matrix3Xd unit = Eigen::Matrix3Xd::Zero(3, system.model.nodes), column;
  for (int k = 0; k < n; ++k) {
    unit.setZero();
    unit(k % 3, system.model.free_columns[k / 3]) = 1;
    multiply(system.model, system.assembly.hessian, unit, column);
    for (int r = 0; r < n; ++r) dense(r, k) = column(r % 3, system.model.free_columns[r / 3]);
  }
  CHECK((dense - dense.transpose()).norm() <= 1e-12 * dense.norm());
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();

  const auto solvers = {make_block_cholesky(system.model), make_cholmod(system.model),
                        make_cholmod(system.model, {.supernodal = false, .own_ordering = false})};
  for (double shift : {0.0, 0.3, 5.0, 500.0}) {
    const int negative = int((eigenvalues.array() < -shift).count());
    for (const auto& solver : solvers) {
      const Inertia inertia = solver->factor(system.assembly.hessian, shift);
      REQUIRE(inertia.usable);
      CHECK(inertia.negative_pivots == negative);
      CHECK(residual(system, *solver, shift) < 1e-8);
    }
  }
  CHECK(eigenvalues[0] < 0);  // the counts above were not all zero
}

TEST_CASE("factorisations: what one left does not stand in the next, on long chains") {
  const System system = bent(70, 6, 12);
  const auto solver = make_block_cholesky(system.model), other = make_cholmod(system.model);
  for (double shift : {0.0, 500.0, 0.3, 500.0}) {
    const Inertia inertia = solver->factor(system.assembly.hessian, shift);
    REQUIRE(inertia.usable);
    CHECK(inertia.negative_pivots == other->factor(system.assembly.hessian, shift).negative_pivots);
    CHECK(residual(system, *solver, shift) < 1e-8);
  }
}

TEST_CASE("factorisations: a singular or infinite matrix is not usable") {
  System system = bent(70, 6, 2);
  const auto solver = make_block_cholesky(system.model);
  for (double bad : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    for (auto& block : system.assembly.hessian.diagonal) block.matrix().setConstant(bad);
    for (auto& block : system.assembly.hessian.pair) block.matrix().setConstant(bad);
    CHECK_FALSE(solver->factor(system.assembly.hessian, 0).usable);
  }
}

TEST_CASE("ordering: a permutation, with about the fill of CHOLMOD's nested dissection") {
  for (int edges : {2, 4, 8}) {
    const System system = bent(126, 12, edges);
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
