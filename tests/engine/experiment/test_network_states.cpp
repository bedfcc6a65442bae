// The states of shells that are no square grid: shaken, pushed and judged as those of grids.
#include <catch2/catch.hpp>

#include "engine/experiment/state_measures.h"
#include "engine/experiment/states.h"
#include "engine/preset/reader.h"

using namespace gridshell;

namespace {

preset::Preset shipped(const std::string& name, preset::JitterMode mode, int trials) {
  const auto read =
      preset::read_preset_file(std::string(GRIDSHELL_SOURCE_DIR) + "/presets/" + name + ".toml");
  if (!read) FAIL(read.error().message);
  preset::Preset p = read->base;
  p.jitter.mode = mode;
  p.jitter.trials = trials;
  return p;
}

experiment::StateLibrary states_of(const preset::Preset& preset) {
  const auto scene = std::make_shared<const Scene>(scene_of(preset).value());
  Watch watch;
  auto found = experiment::find_states(scene, preset.jitter, {.threads = 2}, watch);
  if (!found) FAIL(found.error().message);
  return std::move(*found);
}

void check(const experiment::StateLibrary& library, int trials) {
  int met = 0;
  double before = 0;
  for (const auto& state : library.states) {
    CAPTURE(state.row.state, state.row.group);
    CHECK(state.frame.negative_pivots == 0);
    CHECK(state.frame.residual_N < 1e-6);
    CHECK(state.row.energy_mJ() >= before);
    before = state.row.energy_mJ();
    met += state.row.count;
  }
  // no trial is lost: each met a state, or says why it met none
  CHECK(met > 0);
  CHECK(met <= trials);
}

}  // namespace

TEST_CASE("states of shipped networks are found, stable and in the order of energy", "[full]") {
  for (const char* name : {"network_triaxial", "network_cut", "network_ring", "network_kagome"})
    for (const auto mode :
         {preset::JitterMode::random, preset::JitterMode::gravity, preset::JitterMode::poke}) {
      CAPTURE(name, int(mode));
      check(states_of(shipped(name, mode, 6)), 6);
    }
}

TEST_CASE("a rod of another diameter leaves a network the symmetries that nothing has to prove") {
  preset::Preset p = shipped("network_triaxial", preset::JitterMode::random, 1);
  const auto count = [&] {
    const auto scene = scene_of(p);
    if (!scene) FAIL(scene.error().message);
    const RodMesh mesh = mesh_rods(scene->footprint, 4);
    return experiment::symmetries_of_shell(
               *scene, symmetries_of(mesh, pinned_motion(mesh, scene->motion).at(1)))
        .size();
  };
  CHECK(count() > 1);
  auto& file = p.footprint.file;
  file.diameters.assign(file.rods.size(), 0);
  file.diameters[0] = 0.5;
  CHECK(count() == 1);
}
