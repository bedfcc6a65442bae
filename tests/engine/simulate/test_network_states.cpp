// Searches for states of shells that are no square grid.
#include <algorithm>
#include <set>

#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

preset::Preset searched(const std::string& name, preset::SearchMode mode, int trials) {
  preset::Preset p = shipped(name);
  p.jitter.mode = mode;
  p.jitter.trials = trials;
  return p;
}

study::StateLibrary states_of(const preset::Preset& preset) {
  Watch watch;
  auto found =
      value_of(study::find_states(shared_scene(preset), preset.jitter, {.threads = 2}, watch));
  return found;
}

void check(const study::StateLibrary& library, int trials) {
  int met = 0;
  int ended = library.search.at_rest;
  for (const auto& [why, count] : library.search.ended_otherwise) ended += count;
  CHECK(ended == trials);
  double before = -1e300;
  for (const auto& state : library.states) {
    CAPTURE(state.row.state, state.row.group);
    CHECK(state.frame.negative_pivots == 0);
    CHECK(state.frame.residual_N < 1e-6);
    CHECK(state.row.energy_mJ() >= before);
    before = state.row.energy_mJ();
    CHECK(before == state.frame.energies.total());
    met += state.row.count;
  }
  CHECK(met > 0);
  CHECK(met <= library.search.at_rest);
  // only states that finer meshes do not have are left out
  if (library.search.states_that_finer_meshes_lose == 0) CHECK(met == library.search.at_rest);
}

}  // namespace

TEST_CASE("states of shipped networks are found, stable and in the order of energy", "[full]") {
  for (const char* name :
       {"network_triaxial", "network_cut", "network_ring", "network_kagome", "network_space"})
    for (const auto mode :
         {preset::SearchMode::random, preset::SearchMode::gravity, preset::SearchMode::poke}) {
      CAPTURE(name, int(mode));
      check(states_of(searched(name, mode, 6)), 6);
    }
}

TEST_CASE("a shell has the symmetries that take rods to rods of their kind") {
  preset::Preset p = shipped("network_triaxial");
  const RodMesh mesh = mesh_rods(value_of(scene_of(p)).footprint, 4);
  const auto symmetries = [&] {
    const Scene scene = value_of(scene_of(p));
    return study::symmetries_of_shell(scene, mesh,
                                      symmetries_of(mesh, pinned_motion(mesh, scene.motion).at(1)));
  };
  const auto keeps = [&](const MeshSymmetry& symmetry, std::size_t rod) {
    std::set<int> there, nodes(mesh.rods[rod].begin(), mesh.rods[rod].end());
    for (int node : nodes) there.insert(symmetry.image[std::size_t(node)]);
    return there == nodes;
  };
  const std::vector<MeshSymmetry> all = symmetries();
  const auto keep = [&](std::size_t rod) {
    return std::size_t(std::ranges::count_if(
        all, [&](const MeshSymmetry& symmetry) { return keeps(symmetry, rod); }));
  };
  auto& file = p.footprint.file;
  for (std::size_t rod = 0; rod < mesh.rods.size(); ++rod) {
    CAPTURE(rod);
    file.diameters.assign(file.rods.size(), 0);
    file.diameters[rod] = 0.5;
    const auto left = symmetries();
    CHECK(left.size() == keep(rod));
    CHECK(std::ranges::all_of(left, [&](const auto& one) { return keeps(one, rod); }));
  }
  CHECK(all.size() > keep(0));
  // where all the rods are thicker none is lost
  file.diameters.assign(file.rods.size(), 0.5);
  CHECK(symmetries().size() == all.size());
}
