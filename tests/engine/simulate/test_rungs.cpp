// Rung against rung on nets: what the bend rung leaves out changes nothing on hemisphere and
// saddle.
#include <catch2/catch.hpp>
#include <random>

#include "engine/scene/scene.h"
#include "engine/simulate/actuation.h"
#include "tests/engine/solve/rod_cases.h"

using namespace gridshell;

namespace {

/// largest joint distance over rho between the two rungs at rest, from random edge angles
double distance_of_rungs(const preset::Preset& preset) {
  const auto scene = std::make_shared<const Scene>(scene_of(preset).value());
  const Watch watch;
  const auto bend = simulate::follow_actuation(scene, plan_of_mesh(4), false, 1, watch).value();
  REQUIRE(bend.limit == record::Limit::none);
  const RodMesh& mesh = bend.simulation.shell().mesh(0);
  const Eigen::Matrix3Xd& rest = bend.simulation.shell().state().levels.front().x;

  const Model model = build_model(mesh, circular_material(0.254, 83, 31), RodModel::twist).value();
  State state = start_state(model, columns_of(mesh, model, rest));
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Eigen::Matrix3Xd x = state.x;
  for (int node = 0; node < mesh.joints; ++node)  // and off the bend rung's rest
    x.col(node) += 0.2 * Eigen::Vector3d(normal(random), normal(random), normal(random));
  move_to(model, x, state);
  turn_edges(model, random, state);
  CHECK(energies_of(model, state)[Term::twist] > 10);  // mJ: more than all bending
  Linearisation system(model);
  settle(system, state);
  CHECK(energies_of(model, state)[Term::twist] < 1e-12);
  const Eigen::Matrix3Xd off = state.x.leftCols(mesh.joints) - rest.leftCols(mesh.joints);
  return off.colwise().norm().maxCoeff() / scene->length_scale_mm;
}

preset::Preset on_net(preset::NetKind kind) {
  preset::Preset p;
  p.footprint.kind = preset::FootprintKind::net;
  p.footprint.placement = preset::Placement::on_axis;
  p.net.kind = kind;
  p.net.radius_mm = 120;
  p.net.waist = 0.6;
  p.net.length_mm = 180;
  p.actuation.start = preset::Start::net;
  p.accuracy.edges_per_segment = 4;
  p.accuracy.tolerance = 1e-6;
  return p;
}

}  // namespace

TEST_CASE("twist rung: the hemisphere from random angles is the bend rung's, 4 edges") {
  CHECK(distance_of_rungs(on_net(preset::NetKind::sphere)) < 1e-8);
}

TEST_CASE("twist rung: the saddle from random angles is the bend rung's, 4 edges") {
  CHECK(distance_of_rungs(on_net(preset::NetKind::spool)) < 1e-8);
}
