// What finer meshes choose, followed on coarser ones.
#include "engine/simulate/guided_path.h"

#include <catch2/catch.hpp>

#include "engine/simulate/actuation.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;
using namespace gridshell::simulate;

namespace {

EquilibriumPath actuated(const preset::Preset& preset, const LevelPlan& plan) {
  auto path = follow_actuation(shared_scene(preset), plan, false, 1, unwatched);
  REQUIRE(path);
  path->asked = plan;
  return std::move(*path);
}

const LevelPlan coarse{{4, 8}, false}, fine{{8, 16}, false};

/// Their ends lie no further apart than both estimates say.
void check_same_end(const EquilibriumPath& a, const EquilibriumPath& b) {
  CHECK(a.segments.back().end() == b.segments.back().end());
  CHECK(distance_of_joints(a.simulation, b.simulation.nodes()) <
        a.simulation.certificate().error_estimate_mm +
            b.simulation.certificate().error_estimate_mm);
}

}  // namespace

TEST_CASE("who watches a path sees where it stands and which mesh leads") {
  const Watch watch;
  CHECK(watch.place().edges == 0);
  const preset::Preset p = circle(6, 66, 60, 2);
  const auto path = follow_actuation(shared_scene(p), coarse, false, 1, watch);
  REQUIRE(path);
  CHECK(watch.place().edges == 4);
  CHECK(watch.place().t == path->segments.back().end());
}

TEST_CASE("a guide is followed to its end, back and forth, on coarser meshes") {
  preset::Preset p = circle(12, 126, 94.5, 3);
  p.imperfection.size = 0;
  const EquilibriumPath guide = actuated(p, fine);
  EquilibriumPath path = actuated(p, coarse);
  const auto alone = std::exchange(path.segments, {});
  REQUIRE(follow_guide(path, guide, 1, unwatched));
  REQUIRE(path.segments.size() == guide.segments.size());
  for (std::size_t k = 0; k < path.segments.size(); ++k) {
    CHECK(path.segments[k].back == guide.segments[k].back);
    CHECK(path.segments[k].end() == guide.segments[k].end());
    CHECK(path.segments[k].load_steps.size() == alone[k].load_steps.size());
  }
  check_same_end(path, guide);
  // what is asked of the meshes is asked of their own estimates
  CHECK_FALSE(follow_guide(path, guide, 1e-6, unwatched));
}

TEST_CASE("a guide's leap is leapt where it was told, into its own rest", "[standard]") {
  preset::Preset p = circle(12, 154.04688335955143, 113.9866738043739, 3);
  const EquilibriumPath guide = actuated(p, fine);
  REQUIRE(guide.has_events());
  CHECK_FALSE(uneventful(guide));
  EquilibriumPath path = actuated(p, coarse);
  CHECK(begin_alike(path, guide));
  path.segments.clear();
  REQUIRE(follow_guide(path, guide, 10, unwatched));
  const auto &events = path.segments.back().report.events,
             &told = guide.segments.back().report.events;
  REQUIRE(events.size() == told.size());
  for (std::size_t k = 0; k < events.size(); ++k) {
    CHECK(events[k].t == told[k].t);
    REQUIRE(events[k].to);
    // where its own branch is stable
    CHECK(*events[k].to - *told[k].to < 0.1);
  }
  check_same_end(path, guide);
}

TEST_CASE("where a coarse mesh has no such branch its path is refused") {
  // a leader of 4 edges loses its stability on a way that those of 5 edges and more go to its end
  preset::Preset p = circle(8, 77.9, 63.0, 3);
  const EquilibriumPath guide = actuated(p, fine);
  REQUIRE(uneventful(guide));
  EquilibriumPath path = actuated(p, coarse);
  REQUIRE(path.has_events());
  CHECK_FALSE(follow_guide(path, guide, 10, unwatched));
}
