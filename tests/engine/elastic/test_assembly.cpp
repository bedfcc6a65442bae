// The assembly of both rod models compared with differences of the energy.
#include "engine/elastic/assembly.h"

#include <Eigen/Geometry>
#include <array>
#include <random>

#include "engine/elastic/model.h"
#include "tests/engine/elastic/bent_dome.h"
#include "tests/engine/elastic/differences.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

/// A small dome with noise: every term of the bend model's energy contributes.
BentDome noisy_dome(int edges) {
  BentDome dome = bent_dome(52, 4, edges);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Eigen::Matrix3Xd x = dome.state.x;
  for (double& value : x.reshaped()) value += 0.05 * normal(random);
  dome.state = start_state(dome.model, x);
  return dome;
}

const RodMaterial strip{900, 5, 12, 4, {0.02, -0.01}, 0.03};
const RodMaterial wire{700, 6, 6, 3, {0, 0}, 0};
const ExternalLoads outside{.load = 0.7, .opening = 0.6};

/// Two rods with edges centred on a common joint, one of them clamped, with section axes and a
/// natural shape, hinged and sheared at the joint; a third connected by a spring that ends at a
/// bolt above the second; loads, pressures and ground.
Model sample_model(double hinge = 3.5) {
  const ModelRod a{{0, 1, 2, 3, 4}, {0, 4, 9, 14, 18}, strip,         {},
                   {0, 0, 1, 0, 0}, RodEnd::clamped,   RodEnd::pinned};
  const ModelRod b{{5, 6, 2, 7, 8}, {0, 5, 9, 13, 18}, wire,        {},
                   {0, 0, 1, 0, 0}, RodEnd::tangent,   RodEnd::free};
  const ModelRod c{{9, 10, 11}, {0, 5, 10}, wire, {}, {1, 0, 0}, RodEnd::free, RodEnd::pinned};
  Model model = build_model(12, {a, b, c}, RodModel::twist).value();
  model.springs.push_back({{3, 9, {40, 40, 40}}});
  model.springs.push_back({{10, 8, {3, 0, 5}, Term::support}});
  add_joint_shear(model, {0, 2, 1, 2}, {7.5, 1.4, 0.3});
  add_joint_hinge(model, {0, 2, 1, 2}, hinge);
  add_joint_spin(model, {1, 2, 2, 9}, 2.5);
  add_joint_link(model, {1, 2, 2, 9}, 0.8);
  for (int node = 0; node < 12; ++node) model.loads.push_back({node, {0, 0, -0.1}});
  // pressures on a triangle and on a plane curve
  model.loads.push_back({.node = 1, .pressure = 0.05, .corners = {6, 3}});
  model.loads.push_back({.node = 7, .anchor = {0, 0, 3}, .pressure = 0.3, .corners = {3, -1}});
  model.ground.push_back({6, {0, 0, 0}, {2, 3, 4}, {1, -1, 0.5}});
  // edges 4 of `a` and 6 of `b`, so thick that they press
  model.contact = {
      {2.5, 3},
      {{4, 0, 13, 18, {{{0, 0, 13}, {4, 18, 0}}}}, {6, 1, 0, 5, {{{5, 0, 0}, {8, 18, 13}}}}},
      {2.2, 2.2, 2.2},
      {0, 0, 0}};
  finish(model);
  return model;
}

State sample_state(const Model& model) {
  Eigen::Matrix3Xd x(3, 12);
  x << -9, -5, 0, 4, 9, 0.1, 0, 0, 0, 4, 9, 14,  //
      0, 0, 0, 0, 0, -9, -4, 5, 9, 0, 0, 0,      //
      0, 1, 1.5, 1, 0, 0, 1, 1, 0, 1.2, 1, 0;
  State state = start_state(model, x);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Eigen::Matrix3Xd moved = state.x;
  for (int k = 0; k < 3 * model.nodes; ++k) moved.data()[k] += 0.3 * normal(random);
  for (int place : model.spin) moved.data()[place] += model.spin_length * normal(random);
  move_to(model, moved, state);
  return state;
}

}  // namespace

TEST_CASE("assembly: gradient and Hessian are the energy's derivatives by every unknown") {
  const BentDome dome = noisy_dome(3);
  check_derivatives(dome.model, dome.state, {}, 1e-6, 1e-6, 1e-6);
  const Model model = sample_model();
  const State state = sample_state(model);
  Assembly assembly;
  assemble_gradient(model, state, outside, assembly);
  const Energies alone = energies_of(model, state, outside);
  for (const TermName& term : energy_terms) {
    CAPTURE(term.name);
    CHECK(assembly.energies[term.term] == Approx(alone[term.term]).epsilon(1e-13));
    CHECK(std::abs(alone[term.term]) > 1e-6);  // every term is at work
  }
  check_derivatives(model, state, outside, 1e-8, 1e-6, 1e-7, true);
}

TEST_CASE(
    "joints: rods of a hinge stay perpendicular to the common normal, and edges centred, when all "
    "turn") {
  for (const double stiffness : {3.5, std::numeric_limits<double>::infinity()}) {
    const Model model = sample_model(stiffness);
    const State state = sample_state(model);
    REQUIRE(model.followers.size() == 2);
    REQUIRE(model.hinges.size() == 2);
    for (const ModelFollower& one : model.followers)
      CHECK((state.x.col(one.node) + state.x.col(one.first) - 2 * state.x.col(one.centre)).norm() <
            1e-13);
    const auto across = [&](int edge) {
      const ModelEdge& one = model.edges[std::size_t(edge)];
      return Eigen::Vector3d((state.x.col(one.to) - state.x.col(one.from)).normalized());
    };
    const ModelHinge& hinge = model.hinges[0];
    const Eigen::Vector3d normal = across(hinge.pair.e).cross(across(hinge.pair.f)).normalized();
    for (const int half : {hinge.pair.e, hinge.other_half, model.hinges[1].pair.e})
      CHECK((state.director.col(half) - normal).norm() < 1e-13);
    if (!std::isinf(stiffness)) continue;
    // the twist angle of the hinge's edge is no unknown
    const int place = model.spin[std::size_t(hinge.pair.e)];
    CHECK((model.fixed[std::size_t(place / 3)] >> place % 3 & 1) == 1);
    // rotated rigidly, with the terms of rods and joints alone
    Model free = model;
    free.loads.clear(), free.ground.clear(), free.springs.clear();
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 2).normalized()).toRotationMatrix();
    State turned = state;
    turned.x.leftCols(model.nodes) = turn * state.x.leftCols(model.nodes);
    turned.director = turn * state.director;
    CHECK(energies_of(free, turned).total() ==
          Approx(energies_of(free, state).total()).epsilon(1e-12));
  }
}

TEST_CASE("joints: rods of a hinge that pass one another continue with a negative angle") {
  const ModelRod a{{0, 1, 2, 3, 4}, {0, 4, 9, 14, 18}, strip,       {},
                   {0, 0, 1, 0, 0}, RodEnd::free,      RodEnd::free};
  const ModelRod b{{5, 6, 2, 7, 8}, {0, 4, 9, 14, 18}, strip,       {},
                   {0, 0, 1, 0, 0}, RodEnd::free,      RodEnd::free};
  const double infinite = std::numeric_limits<double>::infinity(), rest = 0.2, stiffness = 7;
  Model model = build_model(9, {a, b}, RodModel::twist).value();
  add_joint_shear(model, {0, 2, 1, 2}, {stiffness, rest, 0, 0, 1});
  add_joint_hinge(model, {0, 2, 1, 2}, infinite);
  finish(model);
  const auto crossed = [&](double angle) {
    Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, model.columns());
    const double at[] = {-9, -5, 0, 5, 9};
    for (int k = 0; k < 5; ++k) {
      x(0, k) = at[k];
      if (k == 2) continue;
      x.col(k < 2 ? 5 + k : 4 + k) << at[k] * std::cos(angle), at[k] * std::sin(angle), 0;
    }
    return x;
  };
  State state = start_state(model, crossed(0.1));
  const double others = energies_of(model, state).total() - energies_of(model, state)[Term::shear];
  for (const double angle : {0.03, -0.04, -0.1}) {
    move_to(model, crossed(angle), state);
    CAPTURE(angle);
    CHECK(is_closed(model, state, model.hinges[0]) == (angle < 0));
    CHECK(state.director.col(model.hinges[0].pair.e).z() == Approx(1));
    const Energies energies = energies_of(model, state);
    CHECK(energies[Term::shear] == Approx(stiffness / 2 * (angle - rest) * (angle - rest)));
    CHECK(energies.total() - energies[Term::shear] == Approx(others));
  }
  check_derivatives(model, state, {}, 1e-7, 1e-5, 1e-6);
}

TEST_CASE(
    "assembly: both methods give one gradient, the mixed residual equals it where N = EA strain") {
  const BentDome dome = noisy_dome(4);
  Assembly with_hessian, alone, mixed;
  assemble_hessian(dome.model, dome.state, {}, {}, with_hessian);
  assemble_gradient(dome.model, dome.state, {}, alone);
  CHECK((with_hessian.gradient - alone.gradient).norm() <= 1e-12 * alone.gradient.norm());
  CHECK(with_hessian.energies.total() == Approx(alone.energies.total()).epsilon(1e-14));
  CHECK(energies_of(dome.model, dome.state).total() ==
        Approx(alone.energies.total()).epsilon(1e-13));
  const Eigen::Matrix3Xd any = Eigen::Matrix3Xd::Random(3, Eigen::Index(dome.model.edges.size()));
  State state = dome.state;
  state.force = alone.force;
  assemble_mixed_residual(dome.model, state, {}, any, mixed);
  CHECK((mixed.gradient - alone.gradient).norm() <= 1e-12 * alone.gradient.norm());
}

TEST_CASE("assembly: large models have the same bits on any number of threads") {
  const BentDome dome = bent_dome(486, 48, 4);
  REQUIRE(dome.model.waves.size() == 2);  // no rod of a direction meets another one
  for (const std::vector<int>& wave : dome.model.waves) CHECK(wave.size() == 48);
  const Eigen::Matrix3Xd any = Eigen::Matrix3Xd::Random(3, Eigen::Index(dome.model.edges.size()));
  const auto all_of = [&](Team* team) {
    std::array<Assembly, 3> all;
    assemble_hessian(dome.model, dome.state, {}, {}, all[0], team);
    assemble_gradient(dome.model, dome.state, {}, all[1], team);
    assemble_mixed_residual(dome.model, dome.state, {}, any, all[2], team);
    return all;
  };
  const auto alone = all_of(nullptr);
  for (int threads : {2, 3, 8}) {
    Team team(threads);
    const auto shared = all_of(&team);
    for (std::size_t k = 0; k < alone.size(); ++k) {
      CHECK(shared[k].gradient == alone[k].gradient);
      CHECK(shared[k].energies.total() == alone[k].energies.total());
      CHECK(shared[k].largest_strain == alone[k].largest_strain);
    }
    Eigen::Matrix3Xd one, other;
    multiply(dome.model, alone[0].hessian, alone[1].gradient, one);
    multiply(dome.model, shared[0].hessian, alone[1].gradient, other);
    CHECK(one == other);
  }
}

TEST_CASE("assembly: rods that meet go one after another, in the order of their list") {
  const auto rod = [](std::vector<int> nodes, bool ring = false) {
    std::vector<double> position;
    for (std::size_t k = 0; k < nodes.size() + ring; ++k) position.push_back(5.0 * double(k));
    const RodEnd end = ring ? RodEnd::free : RodEnd::pinned;
    return ModelRod{std::move(nodes), std::move(position), wire, {}, {}, end, end};
  };
  const Model model =
      build_model(10, {rod({0, 1, 2}), rod({3, 4, 5, 6}, true), rod({7, 1, 4}), rod({8, 9, 7})},
                  RodModel::bend)
          .value();
  CHECK(model.waves == std::vector<std::vector<int>>{{0, 1}, {2}, {3}});
  // the ring's last bend is its own
  CHECK(model.rods[1].closing_bend == int(model.bends.size()) - 1);
  State state = start_state(model, Eigen::Matrix3Xd::Random(3, 10));
  Assembly assembly;
  assemble_gradient(model, state, {}, assembly);
  CHECK(assembly.energies.total() == Approx(energies_of(model, state).total()).epsilon(1e-14));
  CHECK(bending_of(model, state).sum() == Approx(assembly.energies[Term::bend]).epsilon(1e-14));
}

TEST_CASE("assembly: a rigid motion costs nothing, forces and moments balance") {
  const BentDome dome = noisy_dome(2);
  Assembly assembly;
  assemble_gradient(dome.model, dome.state, {}, assembly);
  CHECK(assembly.gradient.rowwise().sum().norm() <= 1e-9 * assembly.gradient.norm());
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (int k = 0; k < dome.model.nodes; ++k)
    moment += Eigen::Vector3d(dome.state.x.col(k)).cross(assembly.gradient.col(k).eval());
  CHECK(moment.norm() <= 1e-9 * assembly.gradient.norm() * 50);

  const ModelRod rod{{0, 1, 2, 3}, {0, 4, 9, 13}, strip, {}, {}, RodEnd::free, RodEnd::free};
  const Model model = build_model(4, {rod}, RodModel::twist).value();
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Random(3, 4);
  x.row(0) += Eigen::RowVector4d(0, 4, 9, 13);
  const State state = start_state(model, x);
  assemble_gradient(model, state, {}, assembly);
  CHECK(assembly.gradient.leftCols(4).rowwise().sum().norm() < 1e-11 * assembly.gradient.norm());
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 2).normalized()).toRotationMatrix();
  State turned = state;
  turned.x.leftCols(4) = turn * state.x.leftCols(4);
  turned.director = turn * state.director;
  CHECK(energies_of(model, turned).total() ==
        Approx(energies_of(model, state).total()).epsilon(1e-12));
}

TEST_CASE("twist model: bad rods are refused with their reason") {
  const ModelRod rod{{0, 1, 2}, {0, 5, 10}, wire};
  CHECK(build_model(3, {rod}, RodModel::twist));
  const auto refused = [&](const char* reason, const auto& change) {
    ModelRod bad = rod;
    change(bad);
    CHECK_THAT(refusal(build_model(3, {bad}, RodModel::twist)), Catch::Contains(reason));
  };
  refused("GJ", [](ModelRod& bad) { bad.material.GJ = 0; });
  refused("EI", [](ModelRod& bad) { bad.material.EI1 = -1; });
  refused("EA", [](ModelRod& bad) { bad.material.EA = std::nan(""); });
  refused("ascend", [](ModelRod& bad) { bad.position = {0, 5, 5}; });
  refused("node 7", [](ModelRod& bad) { bad.nodes = {0, 1, 7}; });
}

TEST_CASE("strain by bending: how far from its natural shape the outermost fibre is bent") {
  // on a circle's arc in the plane of the axes c and s, over so many equal edges
  constexpr int edges = 20;
  constexpr double edge = 2, curvature = 0.01;
  const auto strain_of = [&](const RodMaterial& material, RodModel rod_model, int c, int s) {
    ModelRod rod;
    rod.material = material;
    Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, edges + 1);
    const double turn = 2 * std::atan(curvature * edge / 2);
    for (int k = 0; k <= edges; ++k) {
      rod.nodes.push_back(k);
      rod.position.push_back(edge * k);
      if (k == 0) continue;
      x.col(k) = x.col(k - 1);
      x(c, k) += edge * std::cos(turn * k);
      x(s, k) += edge * std::sin(turn * k);
    }
    const Model model = build_model(edges + 1, {rod}, rod_model).value();
    return bending_strain_of(model, start_state(model, x));
  };
  const auto is = [](const Eigen::VectorXd& strain, double value) {
    return strain.size() == edges - 1 && (strain.array() - value).abs().maxCoeff() < 1e-9;
  };
  // a round wire bends equally in both models and to every side
  for (const RodModel rod_model : {RodModel::bend, RodModel::twist})
    for (const int up : {1, 2})
      CHECK(is(strain_of(circular_material(0.254, 83, 31), rod_model, 0, up), curvature * 0.127));
  // a strip of 0.4 x 0.2: its thickness is up, along m1
  RodMaterial strip = rectangular_material(0.2, 0.4, 83, 31);
  CHECK(is(strain_of(strip, RodModel::twist, 0, 2), curvature * 0.1));
  CHECK(is(strain_of(strip, RodModel::twist, 0, 1), curvature * 0.2));
  CHECK(strip.fibres.strain({curvature, -2 * curvature}) ==
        Approx(curvature * 0.2 + 2 * curvature * 0.1));
  // its natural curvature strains nothing; across it both add up at a corner
  strip.curvature = {0, curvature};
  CHECK(is(strain_of(strip, RodModel::twist, 0, 2), 0));
  strip.curvature = {0, -curvature};
  CHECK(is(strain_of(strip, RodModel::twist, 0, 2), 2 * curvature * 0.1));
  strip.curvature = {0.004, curvature};
  CHECK(is(strain_of(strip, RodModel::twist, 0, 2), 0.004 * 0.2));
}
