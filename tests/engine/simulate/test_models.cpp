// The rod models of a preset: each where it is exact, compared with one another.
#include <cmath>
#include <random>

#include "engine/elastic/model.h"
#include "tests/engine/simulate/run.h"
#include "tests/engine/solve/rod_cases.h"

using namespace gridshell;

namespace {

constexpr double shear_GPa = 31;

preset::Preset four_rods() {
  preset::Preset p = circle(4, 42, 0.85 * 42);
  p.rod.shear_GPa = shear_GPa;
  p.accuracy.edges_per_segment = 4;
  return p;
}

/// The shell of Fig. 1, contracted to 0.9 of its radius, without an imperfection.
preset::Preset twelve_rods() {
  preset::Preset p = circle(12, 126, 0.9 * 126);
  p.imperfection.size = 0;
  return p;
}

/// The largest distance of a joint between the equilibria of the bend and of the twist model, over
/// the length scale. The twist model starts from random edge angles.
double distance_of_rungs(preset::Preset preset, int edges) {
  preset.accuracy.tolerance = 1e-6;
  const auto scene = shared_scene(preset);
  const auto bend =
      value_of(simulate::follow_actuation(scene, plan_of_mesh(edges), false, 1, unwatched));
  REQUIRE(bend.limit == record::Limit::none);
  const RodMesh& mesh = bend.simulation.shell().finest();
  const Eigen::Matrix3Xd& rest = bend.simulation.shell().state().levels.back().x;

  const Model model =
      build_model(mesh, circular_material(0.254, 83, shear_GPa), RodModel::twist).value();
  State state = start_state(model, columns_of(mesh, model, rest));
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  Eigen::Matrix3Xd x = state.x;
  for (int node = 0; node < mesh.joints; ++node)  // and away from the bend model's equilibrium
    x.col(node) += 0.2 * Eigen::Vector3d(normal(random), normal(random), normal(random));
  move_to(model, x, state);
  std::uniform_real_distribution<double> radian(-1, 1);
  for (int k = 0; k < int(model.edges.size()); ++k) set_angle(model, state, k, radian(random));
  CHECK(energies_of(model, state)[Term::twist] > bend.simulation.energies()[Term::bend]);
  Linearisation system(model);
  settle(system, state);
  CHECK(energies_of(model, state)[Term::twist] < 1e-12);
  return max_column_norm(state.x.leftCols(mesh.joints) - rest.leftCols(mesh.joints)) /
         scene->length_scale_mm;
}

}  // namespace

TEST_CASE("twist model: shells from random edge angles are the bend model's") {
  for (const preset::Preset& preset : {on_net(), spool(), twelve_rods()})
    CHECK(distance_of_rungs(preset, 4) < 1e-8);
}

TEST_CASE("twist model: the shell of Fig. 1 from random angles is the bend model's, 16 edges",
          "[standard]") {
  CHECK(distance_of_rungs(twelve_rods(), 16) < 1e-7);
}

TEST_CASE("a circle on the twist model ends where it does on the bend model, without twist") {
  preset::Preset p = four_rods();
  p.accuracy.tolerance = 1e-6;
  const auto bend = run(p);
  p.accuracy.model = RodModel::twist;
  const auto twist = run(p);
  CHECK(bend.summary.model == "bend");
  CHECK(twist.summary.model == "twist");
  CHECK(twist.summary.stable);
  CHECK(twist.summary.residual_N < 1e-7);
  CHECK(twist.summary.energies[Term::twist] < 1e-12);
  CHECK(twist.summary.energies[Term::bend] ==
        Approx(bend.summary.energies[Term::bend]).epsilon(1e-8));
  CHECK(twist.summary.dof > bend.summary.dof);
  CHECK(distance(bend, twist) < 1e-6 * p.footprint.radius_mm);
}

TEST_CASE("loads on the bend model are those of the twist model, and lower the shell") {
  preset::Preset p = four_rods();
  p.accuracy.tolerance = 1e-6;
  const auto unloaded = run(p);
  p.rod.density_kg_m3 = 6450;
  p.loads.gravity_m_s2 = 200;
  p.loads.points = {{0, 0, 0, 0.01, -0.02}};
  const auto bend = run(p);
  CHECK(bend.summary.model == "bend");
  CHECK(bend.summary.stable);
  const auto lowered = [](const simulate::ExperimentResult& outcome) {
    return last_frame(outcome).nodes.row(2).leftCols(outcome.summary.joints).sum();
  };
  CHECK(lowered(bend) < lowered(unloaded) - 0.5);
  CHECK(bend.trajectory.frames.front().residual_N < 1e-9);  // no load on the flat
  p.accuracy.model = RodModel::twist;
  CHECK(distance(bend, run(p)) < 1e-6 * p.footprint.radius_mm);
  p.loads.points = {{7, 0, 0, 0, 1}};
  CHECK_THAT(
      refused_run(p),
      Catch::StartsWith(
          "[loads] points: got [7, 0], which is no joint, expected one of the footprint's "));
}

TEST_CASE("spring joints converge to the shared ones as they stiffen, on both rod models") {
  preset::Preset p = four_rods();
  p.accuracy.model = GENERATE(RodModel::bend, RodModel::twist);
  p.accuracy.tolerance = 1e-5;
  const auto shared = run(p);
  p.joints.kind = preset::JointKind::spring;
  double before = 0;
  for (double stiffness : {1.0, 10.0, 100.0}) {
    p.joints.stiffness_N_per_mm = stiffness;
    const auto spring = run(p);
    CHECK(spring.summary.stable);
    const double off = distance(shared, spring);
    CAPTURE(stiffness, off);
    if (before > 0) CHECK(before / off == Approx(10).epsilon(0.1));
    before = off;
  }
}

TEST_CASE("joints that pass twist twist the rods, the more the stiffer they are") {
  preset::Preset p = four_rods();
  double before = 0;
  for (double stiffness : {0.05, 0.5, 5.0}) {
    p.joints.twist_Nmm = stiffness;
    const auto outcome = run(p);
    CHECK(outcome.summary.stable);
    CHECK(outcome.summary.energies[Term::twist] > 1.2 * before);
    CHECK(outcome.summary.energies[Term::twist] > 1e-4);
    before = outcome.summary.energies[Term::twist];
  }
}

TEST_CASE("joints that resist shear: joints and energies at second order, near short legs too") {
  const auto runs = [](double radius, double to) {
    preset::Preset p = circle(5, radius, to);
    p.rod.shear_GPa = shear_GPa;
    p.joints.shear_Nmm = 2;
    p.imperfection.size = 0;
    std::vector<simulate::ExperimentResult> on;
    for (const int edges : {8, 16, 32, 64}) {
      p.accuracy.edges_per_segment = edges;
      on.push_back(run(p));
      CHECK(on.back().summary.limit == record::Limit::none);
    }
    return on;
  };
  auto on = runs(48, 40);  // legs of 0.4 d and less
  const auto energy = [&](std::size_t k) { return on[k].summary.energies.total(); };
  CAPTURE(energy(0), energy(1), energy(2), energy(3), distance(on[1], on[2]),
          distance(on[2], on[3]));
  // at first order it would be 2
  CHECK(distance(on[1], on[2]) / distance(on[2], on[3]) == Approx(4).epsilon(0.1));
  const auto shear = [&](std::size_t k) { return on[k].summary.energies[Term::shear]; };
  CHECK((shear(1) - shear(2)) / (shear(2) - shear(3)) == Approx(4).epsilon(0.1));
  // Short legs leave a part of third order, of the other sign: with errors a h^2 + b h^3 the
  // differences of neighbouring meshes are a + b, a/4 + b/8, a/16 + b/64 (8 to 64 edges).
  const double first = energy(0) - energy(1), second = energy(1) - energy(2),
               third = energy(2) - energy(3), b = 16 * second - 64 * third, a = 16 * third - b / 4;
  CHECK(b < 0);
  CHECK(first == Approx(a + b).epsilon(0.15));
  // longer legs have less of it
  on = runs(55, 46);
  CHECK((energy(1) - energy(2)) / (energy(2) - energy(3)) == Approx(4).epsilon(0.07));
}

TEST_CASE("a cylinder whose ends are fixed along the helices is its net, to second order") {
  // with ends of prescribed twist too its rods are twisted
  for (const auto hold : {preset::EndKind::tangent, preset::EndKind::clamped}) {
    const bool clamped = hold == preset::EndKind::clamped;
    preset::Preset p = on_net(preset::NetKind::cylinder, clamped ? 60 : 80, clamped ? 280 : 200);
    if (clamped) p.footprint.placement = Placement::half, p.rod.shear_GPa = shear_GPa;
    p.ends.kind = hold;
    double before = 0;
    for (int edges = 4; edges <= (clamped ? 8 : 16); edges *= 2) {
      p.accuracy.edges_per_segment = edges;
      const record::Summary s = run(p).summary;
      CHECK(s.model == (clamped ? "twist" : "bend"));
      CHECK(s.stable);
      CHECK((s.energies[Term::twist] > 0.02) == clamped);
      if (before > 0) CHECK(std::log2(before / s.max_deviation) == Approx(2).margin(0.15));
      before = s.max_deviation;
    }
    CHECK(before < 1e-4);
  }
}

TEST_CASE("a strip lies flat or upright, and an arched rod rises by itself") {
  preset::Preset p = four_rods();
  const double round = run(p).summary.height_mm;
  p.rod.curvature_per_mm = 0.005;
  const auto arched = run(p);
  CHECK(arched.summary.stable);
  // rods with natural curvature are not straight in equilibrium, even in the flat grid
  CHECK(arched.trajectory.frames.front().height_mm > 0.01);
  CHECK(arched.trajectory.frames.front().residual_N < 1e-6);
  // inverted, its rods roll over, as their ends rotate freely, and reach the same state
  p.rod.curvature_per_mm = -0.005;
  CHECK(run(p).summary.energies[Term::bend] ==
        Approx(arched.summary.energies[Term::bend]).epsilon(1e-9));
  p.rod.curvature_per_mm = 0;
  p.rod.width_mm = 0.5;
  p.rod.thickness_mm = 0.15;
  const auto flat = run(p);
  CHECK(flat.summary.stable);
  CHECK(flat.summary.energies[Term::twist] > 1e-3);
  CHECK(flat.summary.height_mm != Approx(round).epsilon(1e-3));
}

TEST_CASE("the net model says that nothing was solved for") {
  preset::Preset p;
  p.footprint.kind = preset::FootprintKind::net;
  p.accuracy.tolerance = 0.05;
  p.movie.frames = 3;
  const auto net = run(p);
  CHECK(net.summary.model == "net");
  CHECK_FALSE(net.summary.solved);
  CHECK(net.summary.limit == record::Limit::none);
  CHECK(std::isnan(net.summary.residual_N));
  CHECK(net.summary.max_deviation == 0);
  REQUIRE(net.trajectory.frames.size() == 2);
  CHECK(net.trajectory.frames.back().negative_pivots == -1);
  CHECK(net.trajectory.frames.back().event == "the net itself, no equilibrium");
  // the shell lies within the tolerance
  p.accuracy.tolerance = 1e-3;
  p.actuation.start = preset::Start::net;
  CHECK(distance(net, run(p)) < 0.05 * p.net.radius_mm);
}

TEST_CASE("a push that snaps is followed in time to the next equilibrium", "[standard]") {
  preset::Preset p;
  p.imperfection.size = 0;  // the state with two mirrors
  p.rod.density_kg_m3 = 6450;
  p.accuracy.edges_per_segment = 4;
  p.indentation.at = preset::IndentationPosition::highest;
  p.indentation.depth_mm = 36;
  p.dynamics.snap = true;
  p.movie.frames = 10;
  const auto outcome = run(p);
  CHECK(outcome.summary.limit == record::Limit::snap);
  CHECK(outcome.summary.stable);
  CHECK(outcome.summary.residual_N < 1e-6);
  double time = 0;
  int moving = 0, at = 0;
  for (const record::Frame& frame : outcome.trajectory.frames) {
    CHECK(frame.index == at++);
    if (std::isnan(frame.time_s)) {
      CHECK(frame.negative_pivots == 0);
      continue;
    }
    ++moving;
    CHECK(frame.event == "in motion");
    CHECK(frame.negative_pivots == -1);
    CHECK(frame.time_s > time);
    CHECK(frame.residual_N > 1e-6);
    time = frame.time_s;
  }
  CHECK(moving > 5);
  CHECK(moving <= 24);
  // without it the equilibrium is the same
  p.dynamics.snap = false;
  CHECK(distance(outcome, run(p)) < 1e-3);
}
