// Rods of two kinds, and dead loads on them.
#include <catch2/catch.hpp>

#include "engine/solve/buckling.h"
#include "engine/solve/nested_shell.h"
#include "tests/engine/solve/single_rod.h"

using namespace gridshell;

namespace {

const Footprint& circle() {
  static const Footprint net = circular_footprint(126, 12, 20, Placement::half).value();
  return net;
}

BoundaryMotion shrinking(const Footprint& net, double ratio) {
  BoundaryMotion motion;
  motion.begin = Eigen::Matrix3Xd::Zero(3, 2 * net.rods.size());
  for (std::size_t r = 0; r < net.rods.size(); ++r) {
    const FootprintRod& rod = net.rods[r];
    const int along = rod.family == Family::u ? 0 : 1;
    for (int end : {0, 1}) {
      motion.begin(along, 2 * r + end) = end == 0 ? rod.span.begin : rod.span.end;
      motion.begin(1 - along, 2 * r + end) = rod.line();
    }
  }
  motion.end = ratio * motion.begin;
  return motion;
}

}  // namespace

TEST_CASE("dead loads: the weight of all rods and the point loads come to the nodes whole") {
  const RodMesh mesh = mesh_rods(circle(), 4);
  ShellRods rods(circular_section(0.254, 83));
  double weight = 0;
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    rods.weight_N_per_mm.push_back(r % 2 == 0 ? 1e-6 : 3e-6);
    weight +=
        rods.weight_N_per_mm.back() * (circle().rods[r].span.end - circle().rods[r].span.begin);
  }
  rods.points.push_back({7, {0.1, 0, -0.3}});
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const NodeAction& load : dead_loads(mesh, rods)) sum += load.force;
  CHECK(sum.x() == Approx(0.1));
  CHECK(sum.y() == 0);
  CHECK(sum.z() == Approx(-0.3 - weight));
  CHECK(dead_loads(mesh, ShellRods(circular_section(0.254, 83))).empty());
}

TEST_CASE("dead loads: a pinned rod bends by P L^3/(48 EI) in the middle, in proportion") {
  // so little that it does not stretch
  const double length = 100, load = 1e-6;
  Model model = build_model(single_rod(40, length), circular_section(0.254, 83)).value();
  const int middle = 21;  // s = L/2
  REQUIRE(model.flat(0, middle) == Approx(length / 2));
  model.loads.push_back({middle, {0, 0, -load}});
  Linearisation system(model);
  State state{Eigen::Matrix3Xd::Zero(3, model.nodes), Eigen::VectorXd::Zero(40)};
  state.x.row(0) = model.flat.row(0);
  for (double factor : {1.0, 0.5}) {
    system.outside.load = factor;
    REQUIRE(newton(system, state, {.tolerance_mm = 1e-9}).outcome == Outcome::reached);
    CHECK(-state.x(2, middle) ==
          Approx(factor * load * std::pow(length, 3) / (48 * circular_section(0.254, 83).EI))
              .epsilon(2e-3));
  }
}

TEST_CASE("dead loads come on with the path: its tangent and the states agree") {
  ShellRods rods(circular_section(0.254, 83));
  rods.weight_N_per_mm.assign(circle().rods.size(), 3.2e-6);
  rods.points.push_back({0, {0, 0, -2e-3}});
  PathOptions options;
  NestedShell shell = NestedShell::make(circle(), rods, RodModel::bend, shrinking(circle(), 0.9),
                                        {{4, 8}, false}, options)
                          .value();
  const auto first =
      first_buckled(shell.system(0), shell.mesh(0), shell.motion(0), 0.6, {}, {}, Watch());
  REQUIRE(first);
  REQUIRE(shell.start(0.6, *first, Watch()).end == Outcome::reached);
  REQUIRE(shell.advance(1, Watch()).end == Outcome::reached);
  CHECK(shell.state().residual_N < 1e-8);
  const Eigen::Matrix3Xd there = shell.state().levels[0].x;

  // no step of the path is needed to see the loads: the same state is found at once
  State again = shell.state().levels[0];
  shell.system(0).outside.load = 1;
  REQUIRE(newton(shell.system(0), again, {}).first_move_mm < 1e-5);
  shell.system(0).outside.load = 0;
  State unloaded = shell.state().levels[0];
  REQUIRE(newton(shell.system(0), unloaded, {}).outcome == Outcome::reached);
  CHECK(max_column_norm(unloaded.x - there) > 0.1);

  // the velocity is the derivative of the states by t
  NestedShell other = NestedShell::make(circle(), rods, RodModel::bend, shrinking(circle(), 0.9),
                                        {{4}, false}, options)
                          .value();
  REQUIRE(other.start(0.6, *first, Watch()).end == Outcome::reached);
  const Eigen::Matrix3Xd velocity = other.followed().velocity.x;
  const double h = 1e-4;
  const Eigen::Matrix3Xd before = other.state().x;
  REQUIRE(other.advance(0.6 + h, Watch()).end == Outcome::reached);
  CHECK(max_column_norm((other.state().x - before) / h - velocity) <
        1e-2 * max_column_norm(velocity));
}

TEST_CASE("rods of two kinds: a circle's state turns with its families") {
  // stiffer u rods are stiffer v rods seen from the other side
  const RodSection thin = circular_section(0.254, 83), thick = circular_section(0.3, 83);
  std::vector<double> energies;
  for (bool u_thick : {true, false}) {
    ShellRods rods;
    for (const FootprintRod& rod : circle().rods)
      rods.materials.push_back(
          round_material((rod.family == Family::u) == u_thick ? thick : thin, 0));
    NestedShell shell = NestedShell::make(circle(), rods, RodModel::bend, shrinking(circle(), 0.9),
                                          {{4}, false}, {})
                            .value();
    const auto first =
        first_buckled(shell.system(0), shell.mesh(0), shell.motion(0), 0.8, {}, {}, Watch());
    REQUIRE(first);
    REQUIRE(shell.start(0.8, *first, Watch()).end == Outcome::reached);
    energies.push_back(energies_of(shell.model(0), shell.state().levels[0]).total());
  }
  CHECK(energies[0] == Approx(energies[1]).epsilon(1e-9));
  NestedShell thin_shell =
      NestedShell::make(circle(), thin, RodModel::bend, shrinking(circle(), 0.9), {{4}, false}, {})
          .value();
  const auto first = first_buckled(thin_shell.system(0), thin_shell.mesh(0), thin_shell.motion(0),
                                   0.8, {}, {}, Watch());
  REQUIRE(first);
  CHECK(energies_of(thin_shell.model(0), *first).total() < energies[0]);
}
