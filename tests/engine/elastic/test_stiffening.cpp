// Bars between joints, and bolts that fix the angle of a joint, compared with differences of their
// energy.
#include <limits>
#include <random>

#include "engine/elastic/model.h"
#include "tests/engine/elastic/bent_dome.h"
#include "tests/engine/elastic/differences.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

constexpr double rigid = std::numeric_limits<double>::infinity();

State perturbed(const Model& model, const State& rest, double by) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  Eigen::Matrix3Xd x = rest.x;
  for (double& value : x.reshaped()) value += by * normal(random);
  return start_state(model, x);
}

/// A dome, its mesh and plain rods.
struct Dome : BentDome {
  RodMesh mesh;
  ShellRods rods{circular_section(0.254, 83)};

  explicit Dome(int edges)
      : BentDome(bent_dome(52, 4, edges)),
        mesh(mesh_rods(circular_footprint(52, 4, 20, Placement::half).value(), edges)) {}
};

Model with(const Dome& dome, const ShellRods& rods) {
  return value_of(build_model(dome.mesh, rods));
}

/// A shell with edges centred on its joints, for bolts.
struct Bolted {
  RodMesh mesh;
  Model loose;
  State state;

  explicit Bolted(int edges) {
    const Dome dome(edges);
    Footprint footprint = circular_footprint(52, 4, 20, Placement::half).value();
    for (FootprintJoint& joint : footprint.joints) joint.centred = true;
    mesh = mesh_rods(footprint, edges);
    loose = value_of(build_model(mesh, dome.rods));
    state = StateTransfer(dome.mesh, dome.model, mesh, loose).carry(dome.state);
  }
  Model with(const Bolts& bolts) const {
    ShellRods rods{circular_section(0.254, 83)};
    rods.bolts = std::make_shared<const Bolts>(bolts);
    return value_of(build_model(mesh, rods));
  }
};

}  // namespace

TEST_CASE("a bar: a strut on both sides, a cable that is slack, becomes taut and pulls") {
  const Dome dome(2);
  const double length = (dome.state.x.col(0) - dome.state.x.col(5)).norm();
  for (const bool cable : {false, true})
    for (const double strain : {-1e-3, 4e-6, 2e-3}) {
      CAPTURE(cable, strain);
      ShellRods rods = dome.rods;
      rods.braces = {{0, 5, length / (1 + strain), 500, cable}};
      const Model model = with(dome, rods);
      const Energies energies = energies_of(model, dome.state);
      const double bar =
          energies[Term::stretch] - energies_of(with(dome, dome.rods), dome.state)[Term::stretch];
      if (cable && strain < 0) CHECK(bar == 0);
      if (strain > 1e-3) CHECK(bar == Approx(0.5 * 500 * length * strain * strain).epsilon(1e-2));
      if (std::abs(strain) > 1e-4) check_derivatives(model, dome.state, {}, 1e-6, 1e-5, 1e-6);
    }
  // where it becomes taut a step of differences must be small compared with that strain
  const NodeBar cable{0, 1, 10, 500, true};
  for (const double strain : {2e-6, 9e-6, 1.5e-5}) {
    constexpr double h = 1e-9;
    CHECK((cable.value(strain + h) - cable.value(strain - h)) / (2 * h * 10) ==
          Approx(cable.force(strain)).epsilon(1e-6));
    CHECK((cable.force(strain + h) - cable.force(strain - h)) / (2 * h) ==
          Approx(cable.stiffness(strain)).epsilon(1e-6));
  }
}

TEST_CASE("bolts are free of stress in the shape they were tightened in, on its mesh exactly") {
  const Bolted dome(4);
  for (const double stiffness : {25.0, rigid}) {
    const Model model = dome.with(tightened(dome.mesh, dome.loose, dome.state, stiffness));
    CHECK(energies_of(model, dome.state)[Term::shear] < 1e-20);
    const State off = perturbed(model, dome.state, 0.02);
    CHECK(energies_of(model, off)[Term::shear] > 1e-8);
    check_derivatives(model, off, {}, 1e-6, 1e-4, 1e-5);
  }
}

TEST_CASE("bolts of one mesh keep the shape of another, exactly on a surface of second degree") {
  const Bolted fine(16);
  const Bolts bolts = tightened(fine.mesh, fine.loose, fine.state, 25);
  for (const int edges : {4, 8}) {
    const Bolted dome(edges);
    CHECK(std::sqrt(energies_of(dome.with(bolts), dome.state)[Term::shear]) < 1e-12);
    CHECK(energies_of(dome.with(bolts), perturbed(dome.loose, dome.state, 0.02))[Term::shear] >
          1e-8);
  }
}

TEST_CASE("a state carried to a model with other springs at its joints takes no torques along") {
  const Bolted shell(4);
  const Model bolted = shell.with(tightened(shell.mesh, shell.loose, shell.state, 5));
  REQUIRE(bolted.forces() > shell.loose.forces());
  State tense = shell.state;
  tense.force.setConstant(0.25);
  const StateTransfer to_bolted(shell.mesh, shell.loose, shell.mesh, bolted);
  const State carried = to_bolted.carry(tense);
  REQUIRE(carried.force.size() == bolted.forces());
  CHECK(carried.force.head(shell.loose.forces()) == tense.force);
  CHECK(carried.force.tail(bolted.forces() - shell.loose.forces()).isZero(0));
}
