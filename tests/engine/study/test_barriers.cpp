#include "engine/study/state_library.h"

#include <catch2/catch.hpp>

#include "engine/formats/csv.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::study;

TEST_CASE("barriers: passes lie above the states that their two sides lead to") {
  preset::Preset p;
  p.name = "shell";
  p.footprint.rods = 6;
  p.footprint.longest_leg = 0.8;
  p.actuation.ratio = 0.75;
  p.accuracy.edges_per_segment = 8;
  p.jitter.trials = 12;
  p.jitter.confined = 7;
  p.jitter.drawn = 3;
  const auto scene = std::make_shared<const Scene>(scene_of(p).value());
  Watch watch;
  auto library = value_of(find_states(scene, p.jitter, {.threads = 1, .lives = false}, watch));
  REQUIRE(library.states.size() > 1);
  StateLibrary again = library;
  const auto found = value_of(barriers_between(library, scene, p.jitter, 1, 0, 1, watch));
  CHECK(library.search.paths_followed > 0);
  REQUIRE(library.search.passes_found > 0);
  CHECK(int(found.size()) <= library.search.passes_found);
  for (const record::Barrier& one : found) {
    CHECK(one.from > 0);
    CHECK(one.barrier_mJ > 0);
    CHECK(one.back_mJ > 0);
    CHECK(one.residual_N < 1e-7);
    const ShellState& from = library.states[std::size_t(one.from) - 1];
    CHECK(one.energy_mJ - one.barrier_mJ == Approx(from.energy_mJ).epsilon(1e-6));
    CHECK(from.row.barrier_mJ <= one.barrier_mJ);
  }
  const auto same = value_of(barriers_between(again, scene, p.jitter, 2, 0, 1, watch));
  CHECK(record::csv_table(same) == record::csv_table(found));
}
