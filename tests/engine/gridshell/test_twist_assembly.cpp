// The twist rung's assembly against differences of its energy, frames carried along.
#include <catch2/catch.hpp>
#include <random>

#include "engine/gridshell/twist_model.h"

using namespace gridshell;

namespace {

/// Two rods that share a node, one of them clamped, with axes and a shape at rest, sheared at the
/// joint; a third hung on by a spring.
TwistModel sample_model() {
  const RodMaterial strip{900, 5, 12, 4, {0.02, -0.01}, 0.03};
  const RodMaterial wire{700, 6, 6, 3, {0, 0}, 0};
  TwistRod a{{0, 1, 2, 3, 4},  {0, 4, 9, 13, 18}, strip,
             RodEnd::clamped, RodEnd::pinned,   {0, 0, 1}};
  TwistRod b{{5, 6, 2, 7, 8}, {0, 5, 9, 14, 18}, wire, RodEnd::tangent, RodEnd::free, {0, 0, 1}};
  TwistRod c{{9, 10, 11}, {0, 5, 10}, wire, RodEnd::free, RodEnd::pinned, {0, 0, 1}};
  TwistModel model = build_twist_model(12, {a, b, c}).value();
  model.springs.push_back({3, 9, 40});
  add_joint_shear(model, 0, 2, 1, 2, 7.5, 1.4);
  add_joint_twist(model, 0, 2, 1, 2, 3.5);
  model.load.row(2).setConstant(-0.1);
  return model;
}

TwistState sample_state(const TwistModel& model) {
  Eigen::Matrix3Xd x(3, 12);
  x << -9, -5, 0, 4, 9, 0.1, 0, 0, 0, 4, 9, 14,  //
      0, 0, 0, 0, 0, -9, -4, 5, 9, 0, 0, 0,      //
      0, 1, 1.5, 1, 0, 0, 1, 1, 0, 1.2, 1, 0;
  TwistState state = start_twist_state(model, x);
  state.load = 0.7;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Eigen::Matrix3Xd moved = state.x;
  Eigen::VectorXd angle = state.angle;
  for (Eigen::Index k = 0; k < moved.size(); ++k) moved.data()[k] += 0.3 * normal(random);
  for (Eigen::Index k = 0; k < angle.size(); ++k) angle[k] += normal(random);
  move_to(model, moved, angle, state);
  return state;
}

TwistState moved(const TwistModel& model, const TwistState& from, const Eigen::VectorXd& step) {
  TwistState state = from;
  const Eigen::Matrix3Xd x =
      from.x + Eigen::Map<const Eigen::Matrix3Xd>(step.data(), 3, model.nodes);
  move_to(model, x, from.angle + step.tail(from.angle.size()), state);
  return state;
}

}  // namespace

TEST_CASE("twist assembly: gradient is the derivative of the energy, by every unknown") {
  const TwistModel model = sample_model();
  const TwistState state = sample_state(model);
  TwistAssembly assembly(model);
  assembly.gradient_at(state);
  CHECK(assembly.energies().total() == Approx(energies_of(model, state).total()).epsilon(1e-13));
  CHECK(assembly.energies()[Term::joint] > 0);
  const double h = 1e-5, scale = assembly.gradient().cwiseAbs().maxCoeff();
  for (int k = 0; k < model.unknowns(); ++k) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(model.unknowns(), k);
    const double up = energies_of(model, moved(model, state, step)).total();
    const double down = energies_of(model, moved(model, state, -step)).total();
    INFO("unknown " << k);
    CHECK(std::abs((up - down) / (2 * h) - assembly.gradient()[k]) <= 1e-8 * scale);
  }
}

TEST_CASE(
    "twist assembly: Hessian is the second derivative of the energy, symmetric part of the "
    "gradient's") {
  const TwistModel model = sample_model();
  const TwistState state = sample_state(model);
  TwistAssembly assembly(model), beside(model);
  assembly.hessian_at(state);
  const Eigen::MatrixXd found = Eigen::MatrixXd(assembly.hessian()).selfadjointView<Eigen::Lower>();
  const double h = 1e-5;
  Eigen::MatrixXd slope(model.dof(), model.dof());
  for (int k = 0; k < model.dof(); ++k) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(model.unknowns(), model.free[k]);
    beside.gradient_at(moved(model, state, step));
    const Eigen::VectorXd up = beside.gradient();
    beside.gradient_at(moved(model, state, -step));
    for (int m = 0; m < model.dof(); ++m)
      slope(m, k) = (up[model.free[m]] - beside.gradient()[model.free[m]]) / (2 * h);
  }
  // a loop of small moves turns the frames: the gradient's own derivative is not symmetric
  const Eigen::MatrixXd symmetric = 0.5 * (slope + slope.transpose());
  CHECK((slope - slope.transpose()).norm() > 1e-4 * found.norm());
  CHECK((found - symmetric).norm() <= 1e-7 * found.norm());
}

TEST_CASE("twist assembly: no energy and no force under rigid motion") {
  const RodMaterial strip{900, 5, 12, 4, {0.02, -0.01}, 0.03};
  const TwistModel model =
      build_twist_model(
          4, {{{0, 1, 2, 3}, {0, 4, 9, 13}, strip, RodEnd::free, RodEnd::free, {0, 0, 1}}})
          .value();
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Random(3, 4);
  x.row(0) += Eigen::RowVector4d(0, 4, 9, 13);
  TwistState state = start_twist_state(model, x);
  const double before = energies_of(model, state).total();
  // a turn of 90 degrees about z in small steps, the angles following the carried frames
  TwistAssembly assembly(model);
  assembly.gradient_at(state);
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int node = 0; node < 4; ++node) force += assembly.gradient().segment<3>(3 * node);
  CHECK(force.norm() < 1e-11 * assembly.gradient().norm());
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 2).normalized()).toRotationMatrix();
  TwistState turned = state;
  turned.x = turn * state.x;
  turned.director = turn * state.director;
  CHECK(energies_of(model, turned).total() == Approx(before).epsilon(1e-12));
}

TEST_CASE("twist model: bad rods are refused with their reason") {
  const RodMaterial wire{700, 6, 6, 3, {0, 0}, 0};
  const auto refused = [](TwistRod rod) {
    const auto model = build_twist_model(3, {std::move(rod)});
    REQUIRE_FALSE(model);
    CHECK(model.error().fault == Fault::bad_input);
    return model.error().message;
  };
  TwistRod rod{{0, 1, 2}, {0, 5, 10}, wire, RodEnd::pinned, RodEnd::pinned, {0, 0, 1}};
  CHECK(build_twist_model(3, {rod}));
  TwistRod bad = rod;
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
