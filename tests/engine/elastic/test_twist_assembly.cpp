// The twist rung's assembly against differences of its energy, frames carried along.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <random>

#include "engine/elastic/assembly.h"

using namespace gridshell;

namespace {

/// Two rods that share a node, one of them clamped, with axes and a shape at rest, sheared at the
/// joint; a third hung on by a spring; loads and ground.
Model sample_model() {
  const RodMaterial strip{900, 5, 12, 4, {0.02, -0.01}, 0.03};
  const RodMaterial wire{700, 6, 6, 3, {0, 0}, 0};
  const ModelRod a{{0, 1, 2, 3, 4}, {0, 4, 9, 13, 18}, strip, RodEnd::clamped, RodEnd::pinned};
  const ModelRod b{{5, 6, 2, 7, 8}, {0, 5, 9, 14, 18}, wire, RodEnd::tangent, RodEnd::free};
  const ModelRod c{{9, 10, 11}, {0, 5, 10}, wire, RodEnd::free, RodEnd::pinned};
  Model model = build_model(12, {a, b, c}, RodModel::twist).value();
  model.springs.push_back({{3, 9, {40, 40, 40}}});
  model.springs.push_back({{10, 8, {3, 0, 5}, Term::support}});
  add_joint_shear(model, 0, 2, 1, 2, 7.5, 1.4);
  add_joint_spin(model, 0, 2, 1, 2, 3.5);
  for (int node = 0; node < 12; ++node) model.loads.push_back({node, {0, 0, -0.1}});
  model.ground.push_back({6, {0, 0, 0}, {2, 3, 4}, {1, -1, 0.5}});
  finish(model);
  return model;
}

const ExternalLoads outside{.load = 0.7};

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

/// The unknowns that exist: positions and angles, held ones too.
std::vector<int> unknowns(const Model& model) {
  std::vector<int> places;
  for (int k = 0; k < 3 * model.nodes; ++k) places.push_back(k);
  places.insert(places.end(), model.spin.begin(), model.spin.end());
  return places;
}

State moved(const Model& model, const State& from, int place, double by) {
  State state = from;
  Eigen::Matrix3Xd x = from.x;
  x.data()[place] += by;
  move_to(model, x, state);
  return state;
}

}  // namespace

TEST_CASE("twist assembly: gradient is the derivative of the energy, by every unknown and term") {
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
  const double h = 1e-5, scale = assembly.gradient.cwiseAbs().maxCoeff();
  for (int place : unknowns(model)) {
    const double up = energies_of(model, moved(model, state, place, h), outside).total();
    const double down = energies_of(model, moved(model, state, place, -h), outside).total();
    INFO("unknown " << place);
    CHECK(std::abs((up - down) / (2 * h) - assembly.gradient.data()[place]) <= 1e-8 * scale);
  }
}

TEST_CASE(
    "twist assembly: Hessian is the second derivative of the energy, symmetric part of the "
    "gradient's") {
  const Model model = sample_model();
  const State state = sample_state(model);
  Assembly assembly, beside;
  assemble_hessian(model, state, outside, {}, assembly);
  const std::vector<int> places = unknowns(model);
  const Eigen::Index n = Eigen::Index(places.size());
  Eigen::MatrixXd found(n, n), slope(n, n);
  const double h = 1e-5;
  Eigen::Matrix3Xd unit, column;
  for (Eigen::Index k = 0; k < n; ++k) {
    unit.setZero(3, model.columns());
    unit.data()[places[std::size_t(k)]] = 1;
    multiply(model, assembly.hessian, unit, column);
    assemble_gradient(model, moved(model, state, places[std::size_t(k)], h), outside, beside);
    const Eigen::Matrix3Xd up = beside.gradient;
    assemble_gradient(model, moved(model, state, places[std::size_t(k)], -h), outside, beside);
    for (Eigen::Index m = 0; m < n; ++m) {
      const int place = places[std::size_t(m)];
      found(m, k) = column.data()[place];
      slope(m, k) = (up.data()[place] - beside.gradient.data()[place]) / (2 * h);
    }
  }
  // a loop of small moves turns the frames: the gradient's own derivative is not symmetric
  const Eigen::MatrixXd symmetric = 0.5 * (slope + slope.transpose());
  CHECK((slope - slope.transpose()).norm() > 1e-5 * found.norm());
  CHECK((found - symmetric).norm() <= 1e-7 * found.norm());
  CHECK((found - found.transpose()).norm() <= 1e-13 * found.norm());
}

TEST_CASE("twist assembly: no energy and no force under rigid motion") {
  const RodMaterial strip{900, 5, 12, 4, {0.02, -0.01}, 0.03};
  const ModelRod rod{{0, 1, 2, 3}, {0, 4, 9, 13}, strip, RodEnd::free, RodEnd::free};
  const Model model = build_model(4, {rod}, RodModel::twist).value();
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Random(3, 4);
  x.row(0) += Eigen::RowVector4d(0, 4, 9, 13);
  const State state = start_state(model, x);
  const double before = energies_of(model, state).total();
  // a turn of 90 degrees about z in small steps, the angles following the carried frames
  Assembly assembly;
  assemble_gradient(model, state, {}, assembly);
  const Eigen::Vector3d force = assembly.gradient.leftCols(4).rowwise().sum();
  CHECK(force.norm() < 1e-11 * assembly.gradient.norm());
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 2).normalized()).toRotationMatrix();
  State turned = state;
  turned.x.leftCols(4) = turn * state.x.leftCols(4);
  turned.director = turn * state.director;
  CHECK(energies_of(model, turned).total() == Approx(before).epsilon(1e-12));
}

TEST_CASE("twist model: bad rods are refused with their reason") {
  const RodMaterial wire{700, 6, 6, 3, {0, 0}, 0};
  const auto refused = [](ModelRod rod) {
    const auto model = build_model(3, {std::move(rod)}, RodModel::twist);
    REQUIRE_FALSE(model);
    CHECK(model.error().fault == Fault::bad_input);
    return model.error().message;
  };
  ModelRod rod{{0, 1, 2}, {0, 5, 10}, wire};
  CHECK(build_model(3, {rod}, RodModel::twist));
  ModelRod bad = rod;
  bad.material.GJ = 0;
  CHECK(refused(bad).find("GJ") != std::string::npos);
  bad = rod;
  bad.material.EI1 = -1;
  CHECK(refused(bad).find("EI") != std::string::npos);
  bad = rod;
  bad.material.EA = std::nan("");
  CHECK(refused(bad).find("EA") != std::string::npos);
  bad = rod;
  bad.position = {0, 5, 5};
  CHECK(refused(bad).find("ascend") != std::string::npos);
  bad = rod;
  bad.nodes = {0, 1, 7};
  CHECK(refused(bad).find("node 7") != std::string::npos);
}
