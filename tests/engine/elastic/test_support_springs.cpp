// Supports on springs: a rod between two of them against formulas, and forces and stiffness against
// differences of the energy.
#include <catch2/catch.hpp>
#include <random>

#include "engine/elastic/shell_rods.h"
#include "engine/solve/buckling.h"
#include "engine/solve/newton.h"

using namespace gridshell;

namespace {

constexpr double length = 100;  // mm
const Eigen::Vector3d k{50, 4, 0.3};

/// A rod from (0, 0, 0) to (100, 0, 0) with a joint in its middle, both ends on springs.
Footprint rod_on_springs() {
  Footprint net;
  net.spacing = length / 2;
  net.joints = {{0, 0, length / 2, 0}};
  net.rods = {FootprintRod::of_grid(Family::u, 0, 0, {0, length})};
  net.rods[0].joints = {0};
  net.rods[0].marks = {length / 2};
  net.rods[0].begin = net.rods[0].end = RodEnd::sprung;
  net.springs = {{0, -1, k}, {1, -1, k}};
  return net;
}

const RodSection section = circular_section(0.254, 83);
const ShellRods rods{round_material(section, 0.3)};

/// Its rest, supports where `motion` ends.
struct Rested {
  RodMesh mesh = mesh_rods(rod_on_springs(), 20);
  Model model;
  State state;
  Assembly at;
  double potential = 0;

  Rested(RodModel rung, double apart, double load_N) {
    model = build_model(mesh, rods, rung).value();
    if (load_N > 0) model.loads.push_back({0, {0, 0, -load_N}});
    BoundaryMotion boundary;
    boundary.begin = Eigen::Matrix3Xd::Zero(3, 2);
    boundary.begin(0, 1) = length;
    boundary.end = boundary.begin;
    boundary.end.row(0) += Eigen::RowVector2d(-apart, apart);
    const PinnedMotion motion = pinned_motion(mesh, boundary);
    Linearisation system(model);
    state = flat_state(model, mesh, motion, {});
    motion.impose(system, 1, state);
    REQUIRE(newton(system, state, {.tolerance_mm = 1e-10}).outcome == Outcome::reached);
    CHECK(system.at(state, false).positive_definite());
    system.gradient_at(state);
    CHECK(system.residual() < 1e-9);
    at = system.assembly();
    potential = system.energy_at(state);
  }
  /// What the support of an end's spring takes.
  Eigen::Vector3d reaction(int end) const {
    return at.gradient.col(mesh.springs[std::size_t(end)].support);
  }
};

}  // namespace

TEST_CASE("a rod pulled by two springs: force 2 a/(2/k + L/EA), supports drawn apart by a each") {
  const double apart = 1, force = 2 * apart / (2 / k.x() + length / section.EA);
  for (const RodModel rung : {RodModel::bend, RodModel::twist}) {
    const Rested rod(rung, apart, 0);
    CHECK(rod.at.force.minCoeff() == Approx(force).epsilon(1e-9));
    CHECK(rod.at.force.maxCoeff() == Approx(force).epsilon(1e-9));
    CHECK((rod.reaction(0) - Eigen::Vector3d(-force, 0, 0)).norm() < 1e-9 * force);
    CHECK((rod.reaction(1) - Eigen::Vector3d(force, 0, 0)).norm() < 1e-9 * force);
    // the end stays behind its support
    CHECK(rod.state.x(0, rod.mesh.joints + 1) == Approx(length + apart - force / k.x()));
    const Energies energies = rod.at.energies;
    CHECK(energies[Term::support] == Approx(force * force / k.x()).epsilon(1e-9));
    CHECK(energies[Term::stretch] ==
          Approx(force * force * length / (2 * section.EA)).epsilon(1e-9));
    CHECK(energies.total() == Approx(force * apart).epsilon(1e-9));
    CHECK(rod.potential == Approx(energies.total()).epsilon(1e-13));
  }
}

TEST_CASE("a rod on two springs sinks by P/(2 k) and bends by P L^3/(48 EI)") {
  // so little that it does not stretch
  const double load = 1e-6;
  const double bent = load * std::pow(length, 3) / (48 * section.EI), sunk = load / (2 * k.z());
  for (const RodModel rung : {RodModel::bend, RodModel::twist}) {
    const Rested rod(rung, 0, load);
    for (const int end : {0, 1}) {
      CHECK(rod.state.x(2, rod.mesh.joints + end) == Approx(-sunk).epsilon(1e-9));
      CHECK(rod.reaction(end).z() == Approx(load / 2).epsilon(1e-9));
    }
    CHECK(-rod.state.x(2, 0) - sunk == Approx(bent).epsilon(2e-3));
    double stored = 0;
    for (const int end : {0, 1})
      stored += 0.5 * rod.reaction(end).cwiseAbs2().cwiseQuotient(k).sum();
    CHECK(rod.at.energies[Term::support] / stored == Approx(1).epsilon(1e-6));
    CHECK(stored >= load * load / (4 * k.z()) * (1 - 1e-9));
  }
}

TEST_CASE("springs of supports: gradient and Hessian are the energy's derivatives, on both rungs") {
  Footprint net = circular_footprint(52.0, 4, 20.0, Placement::half).value();
  net.rods[0].begin = net.rods[5].end = RodEnd::sprung;
  net.held_joints = {3, 4};
  net.springs = {{0, -1, k}, {11, -1, {0, 7, 2}}, {-1, 3, {6, 5, 0}}};
  const RodMesh mesh = mesh_rods(net, 3);
  for (const RodModel rung : {RodModel::bend, RodModel::twist}) {
    const Model model = build_model(mesh, rods, rung).value();
    // the supports and the joint that is held firmly, not what hangs on springs
    for (const MeshSpring& spring : mesh.springs) {
      CHECK(model.pinned(spring.support));
      CHECK_FALSE(model.pinned(spring.node));
    }
    CHECK(model.pinned(4));
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    Eigen::Matrix3Xd nodes(3, mesh.nodes());
    for (int node = 0; node < mesh.nodes(); ++node)
      nodes.col(node) << mesh.flat.col(node), 12 * (1 - mesh.flat.col(node).squaredNorm() / 2704);
    for (double& value : nodes.reshaped()) value += 0.05 * normal(random);
    const State state = start_state(model, columns_of(mesh, model, nodes));
    const auto moved = [&](const Eigen::Matrix3Xd& by) {
      State other = state;
      move_to(model, state.x + by, other);
      return other;
    };
    Assembly here, up, down;
    assemble_hessian(model, state, {}, {}, here);
    CHECK(here.energies[Term::support] > 1e-3);
    for (const MeshSpring& spring : mesh.springs)
      for (const int node : {spring.support, spring.node}) {
        const double h = 1e-5;
        for (int axis = 0; axis < 3; ++axis) {
          Eigen::Matrix3Xd d = Eigen::Matrix3Xd::Zero(3, model.columns()), along;
          d(axis, node) = 1;
          const State plus = moved(h * d), minus = moved(-h * d);
          const double slope =
              (energies_of(model, plus).total() - energies_of(model, minus).total()) / (2 * h);
          CHECK(std::abs(slope - here.gradient(axis, node)) <=
                1e-6 * here.gradient.cwiseAbs().maxCoeff());
          multiply(model, here.hessian, d, along);
          assemble_gradient(model, plus, {}, up);
          assemble_gradient(model, minus, {}, down);
          // of the nodes: frames that are carried along turn the angles' own rows
          const Eigen::Matrix3Xd off = (up.gradient - down.gradient) / (2 * h) - along;
          CHECK(off.leftCols(model.nodes).norm() <= 1e-6 * along.norm());
        }
      }
  }
}

TEST_CASE("nested meshes with springs: what the coarse one has comes to the fine one") {
  Footprint net = rod_on_springs();
  const RodMesh coarse = mesh_rods(net, 4), fine = mesh_rods(net, 8);
  Eigen::Matrix3Xd from = Eigen::Matrix3Xd::Zero(3, coarse.nodes()), to;
  from.topRows(2) = coarse.flat;
  from.row(2) = 0.01 * coarse.flat.row(0);
  from.col(coarse.springs[0].support) << -3, 0, 1;
  from.col(coarse.springs[1].support) << 105, 0, 2;
  MeshTransfer(coarse, fine).nodes(from, to);
  CHECK(to.col(fine.springs[0].support) == Eigen::Vector3d(-3, 0, 1));
  CHECK(to.col(fine.springs[1].support) == Eigen::Vector3d(105, 0, 2));
  CHECK(to(2, fine.joints + 1) == Approx(1));
  CHECK(fine.rod_nodes() == fine.nodes() - 2);
}
