// Rods of two kinds, dead loads on them, and supports on springs.
#include "engine/elastic/shell_rods.h"

#include <random>

#include "engine/elastic/model.h"
#include "engine/solve/nested_shell.h"
#include "tests/engine/elastic/differences.h"
#include "tests/engine/solve/single_rod.h"
#include "tests/presets.h"

using namespace gridshell;

namespace {

constexpr double length = 100;  // mm
const Eigen::Vector3d k{50, 4, 0.3};
const RodSection section = circular_section(0.254, 83);
const ShellRods rods{round_material(section, 0.3)};

const Scene& fig1() {
  static const Scene scene = value_of(scene_of(circle(12, 126, 0.9 * 126)));
  return scene;
}

/// A shell whose boundary is contracted to 0.9 of its size, with its path started at t.
NestedShell formed(const ShellRods& of, double t, const std::vector<int>& edges) {
  NestedShell shell =
      NestedShell::make(fig1().footprint, of, RodModel::bend, fig1().motion, {edges, false}, {})
          .value();
  const State first =
      value_of(first_buckled(shell.system(), shell.finest(), shell.motion(), t, {}, {}, unwatched));
  REQUIRE(shell.start(t, first, unwatched).end == Outcome::reached);
  return shell;
}

double energy(NestedShell& shell) {
  return energies_of(shell.model(), shell.state().levels.back()).total();
}

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

/// The equilibrium of rod_on_springs(): its supports are moved outwards by `apart` each, and its
/// joint is loaded.
struct Equilibrium {
  RodMesh mesh = mesh_rods(rod_on_springs(), 20);
  Model model;
  State state;
  Assembly at;
  double potential = 0;

  Equilibrium(RodModel rod_model, double apart, double load_N) {
    model = build_model(mesh, rods, rod_model).value();
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
  /// Force by the support on the spring of an end, N.
  Eigen::Vector3d reaction(int end) const {
    return at.gradient.col(mesh.springs[std::size_t(end)].support);
  }
};

}  // namespace

TEST_CASE(
    "dead loads: the weight of all rods and the point loads are distributed to the nodes "
    "completely") {
  const RodMesh mesh = mesh_rods(fig1().footprint, 4);
  ShellRods loaded(section);
  double weight = 0;
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    loaded.weight_N_per_mm.push_back(r % 2 == 0 ? 1e-6 : 3e-6);
    const Interval& span = fig1().footprint.rods[r].span;
    weight += loaded.weight_N_per_mm.back() * (span.end - span.begin);
  }
  loaded.points.push_back({7, {0.1, 0, -0.3}});
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const NodeAction& load : dead_loads(mesh, loaded)) sum += load.force;
  CHECK(sum.x() == Approx(0.1));
  CHECK(sum.y() == 0);
  CHECK(sum.z() == Approx(-0.3 - weight));
  CHECK(dead_loads(mesh, ShellRods(section)).empty());
}

TEST_CASE("dead loads are applied along the path: its tangent and the states agree") {
  ShellRods loaded(section);
  loaded.weight_N_per_mm.assign(fig1().footprint.rods.size(), 3.2e-6);
  loaded.points.push_back({0, {0, 0, -2e-3}});
  NestedShell shell = formed(loaded, 0.6, {4, 8});
  REQUIRE(shell.advance(1, unwatched).end == Outcome::reached);
  CHECK(shell.state().residual_N < 1e-8);
  const Eigen::Matrix3Xd there = shell.state().levels.back().x;

  // no step of the path is needed to see the loads: the same state is found at once
  State again = shell.state().levels.back(), unloaded = again;
  shell.system().outside.load = 1;
  REQUIRE(newton(shell.system(), again, {}).first_move_mm < 1e-5);
  shell.system().outside.load = 0;
  REQUIRE(newton(shell.system(), unloaded, {}).outcome == Outcome::reached);
  CHECK(max_column_norm(unloaded.x - there) > 0.1);

  // the velocity is the derivative of the states by t
  NestedShell other = formed(loaded, 0.6, {4});
  const Eigen::Matrix3Xd velocity = other.followed().velocity.x, before = other.state().x;
  const double h = 1e-4;
  REQUIRE(other.advance(0.6 + h, unwatched).end == Outcome::reached);
  CHECK(max_column_norm((other.state().x - before) / h - velocity) <
        1e-2 * max_column_norm(velocity));
}

TEST_CASE("rods of two kinds: a circle's state turns with its families") {
  // stiffer u rods are stiffer v rods seen from the other side
  const RodSection thick = circular_section(0.3, 83);
  const auto with_thick = [&](Family family) {
    ShellRods two;
    for (const FootprintRod& rod : fig1().footprint.rods)
      two.materials.push_back(round_material(rod.family == family ? thick : section, 0));
    NestedShell shell = formed(two, 0.8, {4});
    return energy(shell);
  };
  const double u_thick = with_thick(Family::u);
  CHECK(u_thick == Approx(with_thick(Family::v)).epsilon(1e-9));
  NestedShell thin = formed(section, 0.8, {4});
  CHECK(energy(thin) < u_thick);
}

TEST_CASE(
    "a rod pulled by two springs: force 2 a/(2/k + L/EA), supports moved outwards by a each") {
  const double apart = 1, force = 2 * apart / (2 / k.x() + length / section.EA);
  for (const RodModel rod_model : {RodModel::bend, RodModel::twist}) {
    const Equilibrium rod(rod_model, apart, 0);
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
  // a load so small that the rod does not stretch
  const double load = 1e-6;
  const double bent = load * std::pow(length, 3) / (48 * section.EI),
               settlement = load / (2 * k.z());
  for (const RodModel rod_model : {RodModel::bend, RodModel::twist}) {
    const Equilibrium rod(rod_model, 0, load);
    double stored = 0;
    for (const int end : {0, 1}) {
      CHECK(rod.state.x(2, rod.mesh.joints + end) == Approx(-settlement).epsilon(1e-9));
      CHECK(rod.reaction(end).z() == Approx(load / 2).epsilon(1e-9));
      stored += 0.5 * rod.reaction(end).cwiseAbs2().cwiseQuotient(k).sum();
    }
    CHECK(-rod.state.x(2, 0) - settlement == Approx(bent).epsilon(2e-3));
    CHECK(rod.at.energies[Term::support] / stored == Approx(1).epsilon(1e-6));
    CHECK(stored >= load * load / (4 * k.z()) * (1 - 1e-9));
  }
}

TEST_CASE(
    "springs of supports: gradient and Hessian are the energy's derivatives, on both rod models") {
  Footprint net = circular_footprint(52.0, 4, 20.0, Placement::half).value();
  net.rods[0].begin = net.rods[5].end = RodEnd::sprung;
  net.fixed_joints = {3, 4};
  net.springs = {{0, -1, k}, {11, -1, {0, 7, 2}}, {-1, 3, {6, 5, 0}}};
  const RodMesh mesh = mesh_rods(net, 3);
  for (const RodModel rod_model : {RodModel::bend, RodModel::twist}) {
    const Model model = build_model(mesh, rods, rod_model).value();
    // the supports and the fixed joint are pinned, the nodes on springs are not
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
    CHECK(energies_of(model, state)[Term::support] > 1e-3);
    check_derivatives(model, state, {}, 1e-6, 1e-6, 1e-6);
  }
}

TEST_CASE("nested meshes with springs: the coarse state is transferred to the fine one") {
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
