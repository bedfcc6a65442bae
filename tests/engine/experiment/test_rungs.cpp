// Rung against rung on nets: what the bend rung leaves out changes nothing on hemisphere and saddle.
#include <catch2/catch.hpp>
#include <random>

#include "engine/experiment/actuation.h"
#include "engine/experiment/scene.h"
#include "engine/gridshell/twist_shell.h"
#include "engine/solve/twist_newton.h"

using namespace gridshell;

namespace {

/// largest joint distance over rho between the two rungs at rest, from random edge angles
double distance_of_rungs(const preset::Preset& preset) {
  const auto scene = experiment::scene_of(preset).value();
  Watch watch;
  const auto bend = experiment::run_actuation(scene, {1}, watch).value();
  REQUIRE(bend.limit == record::Limit::none);
  const RodMesh& mesh = bend.shell->mesh(0);
  const Eigen::Matrix3Xd& rest = bend.shell->state().levels.front().x;

  const TwistModel model =
      twist_model_of(mesh, {{circular_material(0.254, 83, 31)}, {}, {}}).value();
  TwistState state = start_twist_state(model, rest);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radian(-1, 1);
  std::normal_distribution<double> normal;
  Eigen::Matrix3Xd x = state.x;
  Eigen::VectorXd angle = state.angle;
  for (Eigen::Index k = 0; k < angle.size(); ++k) angle[k] = radian(random);
  for (int node = 0; node < mesh.joints; ++node)  // and off the bend rung's rest
    x.col(node) += 0.2 * Eigen::Vector3d(normal(random), normal(random), normal(random));
  move_to(model, x, angle, state);
  CHECK(energies_of(model, state)[Term::twist] > 10);  // mJ: more than all bending
  TwistSolver solver(model);
  TwistOptions options;
  options.tolerance_mm = 1e-7;
  const NewtonReport report = solver.rest(state, options, watch);
  REQUIRE(report.outcome == NewtonOutcome::converged);
  CHECK(report.inertia.positive_definite());
  CHECK(energies_of(model, state)[Term::twist] < 1e-12);
  const Eigen::Matrix3Xd off = state.x.leftCols(mesh.joints) - rest.leftCols(mesh.joints);
  return off.colwise().norm().maxCoeff() / scene.length_scale_mm;
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
