#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <random>

#include "engine/elastic/assembly.h"
#include "engine/elastic/shell_rods.h"

using namespace gridshell;

namespace {

struct Bent {
  Model model;
  Eigen::Matrix3Xd x;
};

State at(const Bent& bent, const Eigen::Matrix3Xd& x) { return start_state(bent.model, x); }

/// A small dome with noise: every term of the energy is at work.
Bent bent_shell(int edges) {
  const Footprint net = circular_footprint(52.0, 4, 20.0, Placement::half).value();
  Bent bent{build_model(mesh_rods(net, edges), circular_section(0.254, 83)).value(), {}};
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  bent.x.resize(3, bent.model.nodes);
  for (int k = 0; k < bent.model.nodes; ++k) {
    const Eigen::Vector2d p = bent.model.flat.col(k);
    bent.x.col(k) << 0.97 * p, 12 * (1 - p.squaredNorm() / 2704);
    bent.x.col(k) += 0.05 * Eigen::Vector3d(normal(random), normal(random), normal(random));
  }
  return bent;
}

}  // namespace

TEST_CASE("assembly: gradient is the derivative of the energy") {
  Bent bent = bent_shell(3);
  Assembly assembly;
  assemble_gradient(bent.model, at(bent, bent.x), {}, assembly);
  const double h = 1e-5;
  for (int node = 0; node < bent.model.nodes; node += 3)
    for (int c = 0; c < 3; ++c) {
      Eigen::Matrix3Xd x = bent.x;
      x(c, node) += h;
      const double up = energies_of(bent.model, at(bent, x)).total();
      x(c, node) -= 2 * h;
      const double down = energies_of(bent.model, at(bent, x)).total();
      CHECK(std::abs((up - down) / (2 * h) - assembly.gradient(c, node)) <=
            1e-6 * assembly.gradient.cwiseAbs().maxCoeff());
    }
}

TEST_CASE("assembly: Hessian is the derivative of the gradient, in all blocks") {
  Bent bent = bent_shell(3);
  Assembly assembly, up, down;
  assemble_hessian(bent.model, at(bent, bent.x), {}, {}, assembly);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 5; ++trial) {
    Eigen::Matrix3Xd d(3, bent.model.nodes), along;
    for (Eigen::Index k = 0; k < d.size(); ++k) d.data()[k] = normal(random);
    multiply(bent.model, assembly.hessian, d, along);
    const double h = 1e-5;
    assemble_gradient(bent.model, at(bent, bent.x + h * d), {}, up);
    assemble_gradient(bent.model, at(bent, bent.x - h * d), {}, down);
    const Eigen::Matrix3Xd difference = (up.gradient - down.gradient) / (2 * h);
    CHECK((difference - along).norm() <= 1e-6 * along.norm());
  }
}

TEST_CASE("assembly: both ways give one gradient, the mixed residual is it where N = EA strain") {
  Bent bent = bent_shell(4);
  Assembly with_hessian, alone, mixed;
  assemble_hessian(bent.model, at(bent, bent.x), {}, {}, with_hessian);
  assemble_gradient(bent.model, at(bent, bent.x), {}, alone);
  CHECK((with_hessian.gradient - alone.gradient).norm() <= 1e-12 * alone.gradient.norm());
  CHECK(with_hessian.energies.total() == Approx(alone.energies.total()).epsilon(1e-14));
  CHECK(energies_of(bent.model, at(bent, bent.x)).total() ==
        Approx(alone.energies.total()).epsilon(1e-13));
  const Eigen::Matrix3Xd any = Eigen::Matrix3Xd::Random(3, Eigen::Index(bent.model.edges.size()));
  State state = at(bent, bent.x);
  state.force = alone.force;
  assemble_mixed_residual(bent.model, state, {}, any, mixed);
  CHECK((mixed.gradient - alone.gradient).norm() <= 1e-12 * alone.gradient.norm());
}

TEST_CASE("assembly: a rigid motion costs nothing, forces and moments balance") {
  Bent bent = bent_shell(2);
  Assembly assembly;
  assemble_gradient(bent.model, at(bent, bent.x), {}, assembly);
  CHECK(assembly.gradient.rowwise().sum().norm() <= 1e-9 * assembly.gradient.norm());
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (int k = 0; k < bent.model.nodes; ++k)
    moment += Eigen::Vector3d(bent.x.col(k)).cross(Eigen::Vector3d(assembly.gradient.col(k)));
  CHECK(moment.norm() <= 1e-9 * assembly.gradient.norm() * 50);
}
