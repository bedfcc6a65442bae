// What finer meshes choose, followed on coarser ones.
#include "engine/simulate/mesh_policy.h"

#include <cmath>
#include <memory>

#include "engine/simulate/mesh_policy.h"
#include "tests/engine/simulate/run.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::simulate;

namespace {

EquilibriumPath actuated(const preset::Preset& preset, const LevelPlan& plan) {
  auto path = value_of(follow_actuation(shared_scene(preset), plan, false, 1, unwatched));
  path.asked = plan;
  return path;
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
  const auto path = value_of(follow_actuation(shared_scene(p), coarse, false, 1, watch));
  CHECK(watch.place().edges == 4);
  CHECK(watch.place().t == path.segments.back().end());
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

TEST_CASE("where its leader alone loses the branch a path ends, and a finer leader decides") {
  const preset::Preset p = circle(8, 77.9, 63.0, 3);
  LevelPlan plan = coarse;
  plan.finest_decides = true;
  const auto ended = std::make_shared<EquilibriumPath>(actuated(p, plan));
  const Report& lost = ended->segments.back().report;
  REQUIRE(lost.end != Outcome::reached);
  REQUIRE(lost.events.size() == 1);
  CHECK_FALSE(lost.events.back().to);
  const auto scene = shared_scene(p);
  const Follow follow = [&](const LevelPlan& on, const Watch& watch) {
    return follow_actuation(scene, on, false, 1, watch).map([](EquilibriumPath&& path) {
      return std::make_shared<EquilibriumPath>(std::move(path));
    });
  };
  const auto finer = value_of(led_by_twice_the_edges(*scene, *ended, follow, unwatched));
  REQUIRE(finer);
  CHECK(settles(*finer, *ended));
  CHECK_FALSE(settles(*ended, *finer));
  CHECK(finer->asked.edges_per_segment.front() == 8);
  check_same_end(*finer, actuated(p, fine));
}

TEST_CASE("finer meshes confirm a path without events by three of its states") {
  preset::Preset p = circle(6, 66, 55, 3);
  p.accuracy.tolerance = 1e-2;
  const auto scene = shared_scene(p);
  const auto path = [&](bool one_motion) {
    auto found = converged_path(
        *scene,
        [&](const LevelPlan& on, const Watch& watch) {
          return follow_actuation(scene, on, false, 1, watch);
        },
        unwatched, one_motion);
    REQUIRE(found);
    return std::move(*found);
  };
  EquilibriumPath by_states = path(true), followed = path(false);
  CHECK(by_states.asked.edges_per_segment == followed.asked.edges_per_segment);
  CHECK(by_states.simulation.nodes() == followed.simulation.nodes());
  CHECK(3 * by_states.simulation.effort().factorizations <
        2 * followed.simulation.effort().factorizations);

  auto finer = value_of(Simulation::open(scene, {{8, 16}, false}));
  CHECK(has_states_of(finer, by_states, unwatched));
  // a state that no mesh has
  State& last = by_states.segments.back().load_steps.back().point.state;
  last.x.row(2).leftCols(by_states.simulation.shell().finest().joints) *= 1.2;
  CHECK_FALSE(has_states_of(finer, by_states, unwatched));
}

TEST_CASE("48 rods rise evenly where a leader of 4 edges alone loses their branch", "[full]") {
  preset::Preset p = circle(48, 486, 364.5, 120);
  p.accuracy.tolerance = 1e-2;
  const auto outcome = run(p);
  const auto& frames = outcome.trajectory.frames;
  REQUIRE(frames.size() == 120);
  // at progress 0.34 to 0.44; a state of another branch is 1 mm higher
  for (std::size_t k = 25; k < 60; ++k) {
    const double rise = frames[k + 1].height_mm - frames[k].height_mm,
                 before = frames[k].height_mm - frames[k - 1].height_mm;
    INFO("frame " << k << ": " << before << ", " << rise);
    CHECK(rise > 0);
    CHECK(std::abs(rise - before) < 0.25 * before);
  }
}
