// The first buckled state: the one that the seed asks for, whatever mesh is asked for.
#include "engine/simulate/first_state.h"

#include <catch2/catch.hpp>

#include "engine/simulate/simulation.h"
#include "tests/engine/simulate/network_preset.h"
#include "tests/presets.h"

using namespace gridshell;

namespace {

/// A superellipse whose dome has several states of rest close to one another: brought to rest on
/// each mesh by itself, it came to states 0.6 mm apart in height.
Scene many_states() {
  return value_of(scene_of(superellipse(123.26901689171791, 102.08232879638672, 3.0916969776153564,
                                        0.8719519721716642)));
}

Energies first_energies(const std::shared_ptr<const Scene>& scene, int edges) {
  Simulation session = Simulation::open(scene, {.edges_per_segment = {edges}}).value();
  const Watch watch;
  const Report report = session.begin_buckled(0.02, watch).value();
  REQUIRE(report.end == Outcome::reached);
  CHECK(report.certificate.stable());
  return session.energies();
}

}  // namespace

TEST_CASE("the first buckled state is the same one on meshes of every family") {
  const auto scene = std::make_shared<const Scene>(many_states());
  // second order: 4 edges are the furthest off
  const double coarse = first_energies(scene, 4).total(), fine = first_energies(scene, 10).total();
  for (int edges : {5, 6, 7, 8}) {
    CAPTURE(edges, coarse, fine);
    const double expected =
        fine + (coarse - fine) * (1.0 / (edges * edges) - 0.01) / (1.0 / 16 - 0.01);
    CHECK(first_energies(scene, edges).total() == Approx(expected).epsilon(2e-3));
  }
}

TEST_CASE("rods too thick to buckle while they are soft go to the side of the seed") {
  preset::NetworkData cross;
  cross.points = {{-50, 0, 0}, {50, 0, 0}, {0, -50, 0}, {0, 50, 0}, {0, 0, 0}};
  cross.rods = {{0, 4, 1}, {2, 4, 3}};
  preset::Preset p = network(cross, 4);
  p.actuation.scale = 0.88;
  p.rod.diameter_mm = 2;
  for (const auto seed : {preset::Seed::up, preset::Seed::down}) {
    p.actuation.seed = seed;
    const auto scene = std::make_shared<const Scene>(value_of(scene_of(p)));
    Simulation simulation = value_of(Simulation::open(scene, {.edges_per_segment = {4}}));
    REQUIRE(value_of(simulation.begin_buckled(0.02, unwatched)).end == Outcome::reached);
    const double joint = simulation.nodes()(2, 0);
    CHECK((seed == preset::Seed::up ? joint : -joint) > 5);
  }
}
