// The choice of the meshes on which a path is followed: what the companion mesh confirms, when the
// edges are doubled, and what is reported as not confirmed.
#include "engine/simulate/mesh_policy.h"

#include <cmath>
#include <memory>

#include "tests/engine/simulate/run.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::simulate;

namespace {

EquilibriumPath actuated(const preset::Preset& preset, const LevelPlan& plan) {
  auto path = value_of(follow_actuation(shared_scene(preset), plan, false, 1, unwatched));
  path.meshes = plan;
  return path;
}

/// What a test prescribes of the path on one mesh.
struct Prescribed {
  bool too_coarse = false;         ///< whether its estimate misses the tolerance
  std::optional<bool> event = {};  ///< whether the companion has it
  double event_t = 0.5;
};

/// Applies the policy to prescribed paths, prescribed(edges), which are not followed; `tried` gets
/// the edges of the meshes in order.
template <class Prescribe>
Result<EquilibriumPath> policy(const Scene& scene, const Prescribe& prescribed,
                               std::vector<int>& tried) {
  const auto shared = std::make_shared<const Scene>(scene);
  const Follow follow = [&](const LevelPlan& plan, const Watch&) -> Result<EquilibriumPath> {
    const int edges = plan.edges_per_segment.back();
    tried.push_back(edges);
    auto simulation = Simulation::open(shared, plan);
    if (!simulation) return tl::unexpected<Error>(simulation.error());
    if (simulation->begin_flat().end != Outcome::reached)
      return fail(Fault::no_equilibrium, "the flat");
    EquilibriumPath path{std::move(*simulation)};
    const Prescribed one = prescribed(edges);
    PathSegment segment{{}, 0, 1, {}};
    LoadStep step{path.simulation.shell().point(), {}};
    step.point.t = 1;
    step.certificate.error_estimate_mm = one.too_coarse ? 1 : 1e-3;
    segment.load_steps.push_back(step);
    if (one.too_coarse && std::isfinite(plan.allowed_mm)) segment.report.end = Outcome::too_coarse;
    if (one.event) {
      Event event{.t = one.event_t, .error = {}, .to = one.event_t + 0.01};
      event.confirmed = *one.event;
      event.location = {edges, one.event_t, 0};
      segment.report.events.push_back(event);
    }
    path.segments.push_back(std::move(segment));
    return path;
  };
  return converged_path(scene, follow, unwatched);
}

const Scene& small() {
  static const Scene scene = value_of(scene_of(circle(4, 44, 40, 2)));
  return scene;
}

}  // namespace

TEST_CASE("a path that its companion confirms is followed once") {
  std::vector<int> tried;
  const auto path = value_of(policy(
      small(), [](int) { return Prescribed{}; }, tried));
  CHECK(tried == std::vector<int>{8});
  CHECK(path.mesh_disagreement.empty());
  CHECK_FALSE(path.tolerance_missed);
}

TEST_CASE("an event that the companion does not have takes twice the edges, until one has it") {
  std::vector<int> tried;
  const auto prescribed = [](int edges) {
    return Prescribed{false, edges >= 32, std::log2(edges) / 8};
  };
  const auto path = value_of(policy(small(), prescribed, tried));
  CHECK(tried == std::vector<int>{8, 16, 32});
  CHECK(path.mesh_disagreement.empty());
}

TEST_CASE("two meshes that agree are enough, and the event lies between them") {
  std::vector<int> tried;
  const auto prescribed = [](int edges) {
    return Prescribed{false, false, edges == 8 ? 0.5 : 0.488};
  };
  const auto path = value_of(policy(small(), prescribed, tried));
  CHECK(tried == std::vector<int>{8, 16});
  CHECK(path.mesh_disagreement.empty());
  const Event& event = path.segments[0].report.events[0];
  CHECK(event.t == Approx(0.488 - 0.012 / 3));
  CHECK(event.error.value() == Approx(0.012 / 3));
}

TEST_CASE("meshes that never agree are doubled three times, and the doubt is said") {
  std::vector<int> tried;
  const auto prescribed = [](int edges) { return Prescribed{false, false, std::log2(edges) / 8}; };
  const auto path = value_of(policy(small(), prescribed, tried));
  CHECK(tried == std::vector<int>{8, 16, 32, 64});
  CHECK_THAT(path.mesh_disagreement, Catch::StartsWith("32 edges per segment do not have the "
                                                       "event at progress 0.5625"));
}

TEST_CASE("a tolerance that no mesh meets keeps what there is, and says what is missed") {
  std::vector<int> tried;
  const auto path = value_of(policy(
      small(), [](int) { return Prescribed{true}; }, tried));
  CHECK(tried == std::vector<int>{8, 16, 32, 64, 128, 128});
  CHECK(path.tolerance_missed);
  CHECK(path.segments.back().report.end == Outcome::reached);
  CHECK_THAT(path.mesh_disagreement, Catch::StartsWith("the tolerance 0.001 is not met: 128 ") &&
                                         Catch::EndsWith(", at progress 1.0000"));
  const auto next = value_of(policy(
      small(),
      [](int) {
        return Prescribed{true, true, 0.97};
      },
      tried));
  CHECK_THAT(next.mesh_disagreement, Catch::EndsWith("1.0000, next to an event, where a state "
                                                     "moves most"));
}

TEST_CASE("a mesh that memory does not have ends the doubling, with its reason") {
  Scene scene = small();
  scene.memory_GB = 1e-9 * 1000 * 20000;
  std::vector<int> tried;
  const auto path = value_of(policy(
      scene, [](int) { return Prescribed{true}; }, tried));
  CHECK(tried.back() < 128);
  CHECK(tried[tried.size() - 2] == tried.back());
  CHECK_THAT(path.mesh_disagreement, Catch::Contains("GB of [accuracy] memory_GB"));
}

TEST_CASE("on a mesh that is requested the companion's doubt is said and nothing is doubled") {
  Scene scene = small();
  scene.edges_per_segment = 8;
  std::vector<int> tried;
  const auto path = value_of(policy(
      scene,
      [](int) {
        return Prescribed{true, false};
      },
      tried));
  CHECK(tried == std::vector<int>{8});
  CHECK_FALSE(path.mesh_disagreement.empty());
}

TEST_CASE("who watches a path sees where it is and which mesh is followed") {
  const Watch watch;
  CHECK(watch.position().edges == 0);
  const preset::Preset p = circle(6, 66, 60, 2);
  const auto path = value_of(follow_actuation(shared_scene(p), {{4, 8}, false}, false, 1, watch));
  CHECK(watch.position().edges == 8);
  CHECK(watch.position().t == path.segments.back().end());
}

TEST_CASE("where the lowest stiffness nearly vanishes a finer mesh decides whether it does",
          "[standard]") {
  // 8 edges per segment keep the symmetric branch, whose lowest stiffness falls to a tenth near
  // progress 0.04; on 12 and more it falls below zero, and the shell leaves that branch for good
  preset::Preset p = superellipse(97.549, 104.313, 4.3314, 0.954516);
  p.accuracy.tolerance = 3.6e-3;
  p.movie.frames = 2;
  const auto chosen = run(p);
  CHECK(chosen.summary.doubt.empty());
  CHECK(chosen.summary.edges_per_segment > 8);
  p.accuracy.edges_per_segment = 8;
  const auto coarse = run(p);
  CHECK(coarse.summary.doubt.find("stability at progress 0.03") != std::string::npos);
  CHECK(distance(coarse, chosen) > 1);
  p.accuracy.edges_per_segment = 24;
  CHECK(distance(run(p), chosen) < 0.05);
}

TEST_CASE("a branch that is stable again further on is left for the one in between") {
  // the boundary moves by 5 mm in all: the symmetric branch loses its stability at 0.183 and has
  // regained it a thousandth of the size later
  const EquilibriumPath path =
      actuated(superellipse(97.549, 104.313, 4.3314, 0.954516), plan_of_mesh(16));
  REQUIRE(path.segments.back().report.events.size() == 1);
  const Event& event = path.segments.back().report.events.front();
  CHECK(event.to.value() < 0.215);
  CHECK_FALSE(event.jump);
}

TEST_CASE("a companion that loses its stability decides nothing") {
  // 4 edges lose it on a path that those of 5 edges and more follow to its end
  const preset::Preset p = circle(8, 77.9, 63.0, 3);
  CHECK(actuated(p, {{4}, false}).segments.back().report.events.size() == 1);
  const EquilibriumPath path = actuated(p, {{4, 8}, false});
  CHECK(path.segments.back().report.events.empty());
  CHECK(path.segments.back().report.end == Outcome::reached);
  // the path is not confirmed, as 4 edges have no state next to its end
  CHECK(not_confirmed(path));
  CHECK_FALSE(not_confirmed(actuated(p, {{8, 16}, false})));
}

TEST_CASE("an event has the error by which two meshes differ", "[standard]") {
  const preset::Preset p = circle(12, 154.04688335955143, 113.9866738043739, 3);
  const EquilibriumPath coarse = actuated(p, {{4, 8}, false}),
                        fine = actuated(p, {{16, 32}, false});
  const auto &events = coarse.segments.back().report.events,
             &exact = fine.segments.back().report.events;
  REQUIRE(events.size() == exact.size());
  REQUIRE_FALSE(events.empty());
  for (std::size_t k = 0; k < events.size(); ++k) {
    CAPTURE(k, events[k].t, exact[k].t);
    CHECK(events[k].confirmed);
    CHECK(std::abs(events[k].t - exact[k].t) < *events[k].error + *exact[k].error);
  }
}

TEST_CASE("a path whose estimate passes the tolerance ends there", "[standard]") {
  LevelPlan plan{{4, 8}, false};
  plan.allowed_mm = 0.03;
  const EquilibriumPath path = actuated(circle(12, 126, 94.5, 3), plan);
  CHECK(path.too_coarse());
  CHECK(path.segments.back().load_steps.back().certificate.error_estimate_mm > 0.03);
  CHECK(path.segments.back().end() < 1);
}

TEST_CASE("a path whose first state passes the tolerance is not followed", "[standard]") {
  LevelPlan plan{{4, 8}, false};
  const double first = actuated(circle(12, 126, 94.5, 3), plan)
                           .segments.front()
                           .load_steps.front()
                           .certificate.error_estimate_mm;
  plan.allowed_mm = 0.9 * first;
  const EquilibriumPath path = actuated(circle(12, 126, 94.5, 3), plan);
  CHECK(path.too_coarse());
  CHECK(path.segments.front().load_steps.size() == 1);
  // nor is another first state searched for, which could be on another branch
  CHECK(path.segments.size() == 1);
  CHECK(path.segments.front().back);
}

TEST_CASE("48 rods rise evenly where a mesh of 4 edges alone loses their branch", "[full]") {
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
