// Equilibria from rough states over meshes of increasing fineness, and their stiffness.
#include "engine/study/multilevel_relaxation.h"

#include <random>

#include "engine/elastic/model.h"
#include "engine/solve/newton.h"
#include "tests/engine/solve/single_rod.h"
#include "tests/presets.h"

using namespace gridshell;

namespace {

MultilevelRelaxation cascade_of(int rods) {
  const Scene scene = value_of(scene_of(paper_circle(rods)));
  return MultilevelRelaxation::make(scene.footprint, scene.rods, scene.solved_model(), scene.motion,
                                    scene.flat, 4)
      .value();
}

Eigen::Matrix3Xd random_start(const MultilevelRelaxation& cascade, unsigned seed) {
  std::mt19937 random{seed};
  Eigen::Matrix3Xd nodes = cascade.stretched_flat(1);
  for (double& coordinate : nodes.reshaped())
    coordinate += 20 * (double(random()) / double(1u << 31) - 1);
  return nodes;
}

}  // namespace

TEST_CASE("cascade: nineteen of twenty rough states of eight rods reach a stable equilibrium") {
  MultilevelRelaxation cascade = cascade_of(8);
  int at_rest = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto rest = cascade.rest(1, random_start(cascade, seed), unwatched);
    if (!rest) continue;
    ++at_rest;
    CHECK(cascade.system().at(*rest, false).positive_definite());
    CHECK(cascade.system().residual() < 1e-3);
  }
  CHECK(at_rest >= 19);
}

TEST_CASE("cascade: nodes that are no numbers are an error, a cancel is answered") {
  MultilevelRelaxation cascade = cascade_of(4);
  Eigen::Matrix3Xd nodes = cascade.stretched_flat(1);
  check_stops([&](const Watch& watch) { return cascade.rest(1, nodes, watch); });
  nodes.setConstant(std::numeric_limits<double>::quiet_NaN());
  CHECK_THAT(refusal(cascade.rest(1, nodes, unwatched), Fault::no_equilibrium),
             Catch::StartsWith("no equilibrium after 1 iterations"));
}

TEST_CASE(
    "cascade: a confined form keeps its group where it is stable, and converges in any case") {
  MultilevelRelaxation cascade = cascade_of(8);
  int kept = 0;
  for (const SymmetryGroup& group : subgroups(cascade.symmetries())) {
    const auto rest = cascade.rest_confined(1, random_start(cascade, 7), group, unwatched);
    if (!rest) continue;
    CHECK(cascade.system().at(*rest, false).positive_definite());
    const auto has = group_of(cascade.symmetries(), rest->x.leftCols(cascade.finest().joints), 0.1);
    kept += std::includes(has.begin(), has.end(), group.begin(), group.end());
  }
  CHECK(kept >= 2);
}

TEST_CASE("eigenvalue: a straight pinned rod has EI (pi/L)^4, on two meshes at second order") {
  const double length = 100;
  const RodSection section = circular_section(0.254, 83);
  const auto found = [&](int edges, double stretch) {
    const RodMesh mesh = single_rod(edges, length);
    const Model model = build_model(mesh, section).value();
    Linearisation system(model);
    const State state = start_state(model, straight(model, stretch));
    return lowest_eigenvalue(system, state, lumped(mesh, {1.0}), unwatched);
  };
  const double exact = section.EI * std::pow(M_PI / length, 4);
  const double coarse = found(20, 1), fine = found(40, 1);
  CHECK(coarse == Approx(exact).epsilon(5.0 / 400));
  CHECK(fine == Approx(exact).epsilon(5.0 / 1600));
  CHECK((coarse - exact) / (fine - exact) == Approx(4).epsilon(0.1));
  // an unstable state has no such eigenvalue
  CHECK(std::isnan(found(20, 0.98)));
}
