// Rung against rung: the circular shell of Fig. 1 on the twist rung, from random edge angles.
#include <catch2/catch.hpp>
#include <chrono>
#include <random>

#include "engine/elastic/shell_rods.h"
#include "engine/solve/buckling.h"
#include "tests/engine/solve/rod_cases.h"

using namespace gridshell;

namespace {

constexpr double R_o = 126;

/// the bend rung's shell, first buckled at 2 % shortening, then at rest at R_a = 0.9 R_o
struct Shell {
  Footprint footprint = circular_footprint(R_o, 12, 20, Placement::half).value();
  RodMesh mesh;
  Model model;
  State state;

  explicit Shell(int edges) : mesh(mesh_rods(footprint, edges)) {
    model = build_model(mesh, circular_section(0.254, 83)).value();
    Linearisation system(model);
    PinnedMotion motion;
    motion.begin = Eigen::Matrix3Xd::Zero(3, model.nodes);
    motion.begin.topRows(2) = mesh.flat;
    motion.change = -0.1 * motion.begin;
    state = first_buckled(system, mesh, motion, 1, {}, {}, Watch()).value();
    NewtonOptions options;
    options.tolerance_mm = 1e-7;
    const NewtonReport report = newton(system, state, options);
    REQUIRE(report.last_move_mm < 1e-6);
  }
};

/// largest joint distance over R_o between the rungs
double distance_of_rungs(int edges, double& twist_before, double& seconds) {
  const Shell shell(edges);
  const Model model =
      build_model(shell.mesh, circular_material(0.254, 83, 31), RodModel::twist).value();
  State state = start_state(model, columns_of(shell.mesh, model, shell.state.x));
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  Eigen::Matrix3Xd x = state.x;
  for (int node = 0; node < shell.mesh.joints; ++node)  // and off the bend rung's rest
    x.col(node) += 0.2 * Eigen::Vector3d(normal(random), normal(random), normal(random));
  move_to(model, x, state);
  turn_edges(model, random, state);
  twist_before = energies_of(model, state)[Term::twist];
  Linearisation system(model);
  const auto start = std::chrono::steady_clock::now();
  settle(system, state);
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  CHECK(energies_of(model, state)[Term::twist] < 1e-12);
  const int joints = shell.mesh.joints;
  return (state.x.leftCols(joints) - shell.state.x.leftCols(joints)).colwise().norm().maxCoeff() /
         R_o;
}

}  // namespace

TEST_CASE("twist rung: the shell of Fig. 1 from random angles is the bend rung's, 4 edges") {
  double twist = 0, seconds = 0;
  const double off = distance_of_rungs(4, twist, seconds);
  CAPTURE(off, twist, seconds);
  CHECK(twist > 100);  // mJ: the bend energy is about 20
  CHECK(off < 1e-8);
}

TEST_CASE("twist rung: the shell of Fig. 1 from random angles is the bend rung's, 16 edges",
          "[standard]") {
  double twist = 0, seconds = 0;
  const double off = distance_of_rungs(16, twist, seconds);
  CAPTURE(off, twist, seconds);
  CHECK(off < 1e-7);
}
