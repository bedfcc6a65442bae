// A design that is watched: its steps as they come, and where it stands when it is stopped.
#include "engine/design/design.h"

#include <catch2/catch.hpp>

#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

preset::Preset low_cap() {
  preset::Preset p = cap(0.7);
  p.inverse.vary = {preset::Vary::pins};
  return p;
}

struct Handed {
  std::vector<DesignStep> steps;
  std::vector<Eigen::Matrix3Xd> joints;
  std::vector<preset::Points> ends;
};

/// All that is handed over; `after` each.
Result<LiveDesignResult> live(const preset::Preset& preset, const Watch& watch, Handed& handed,
                              const std::function<void()>& after = {}) {
  const auto scene = shared_scene(preset);
  const Simulation session = on_its_net(scene, 8);
  const NestedShell& shell = session.shell();
  return design_live(preset, {scene, shell.mesh(0), shell.model(0), shell.state().levels[0]}, 25,
                     watch, [&](const CertifiedStep& now) {
                       handed.steps.push_back(now.step);
                       handed.joints.push_back(now.shell.joints());
                       handed.ends.push_back(now.ends);
                       CHECK(now.distances_mm.maxCoeff() == Approx(now.step.max_mm));
                       CHECK(now.shell.residual() < 1e-6);
                       if (after) after();
                     });
}

}  // namespace

TEST_CASE("a design that is watched hands over every step that both meshes hold", "[standard]") {
  Handed handed;
  const auto end = value_of(live(low_cap(), unwatched, handed));
  CHECK_FALSE(end.stopped);
  REQUIRE(handed.steps.size() > 3);
  CHECK(handed.steps.front().iteration == 0);
  CHECK(handed.steps.back().max_mm < 0.35 * handed.steps.front().max_mm);
  for (const DesignStep& step : handed.steps) CHECK(step.taken);
  // it comes to what the design that nobody watches does
  Watch watch;
  const auto whole = value_of(design(low_cap(), watch));
  CHECK(handed.steps.back().max_mm == Approx(whole.after.front().max_mm).epsilon(1e-4));
  REQUIRE(end.rounded_max_mm.has_value());
  CHECK(*end.rounded_max_mm == Approx(whole.rounded->max_mm).epsilon(1e-3));
}

TEST_CASE("stopped, a design stands in the last step that it handed over") {
  Handed all, some;
  REQUIRE(live(low_cap(), unwatched, all).has_value());
  Watch watch;
  const auto end = live(low_cap(), watch, some, [&] {
    if (some.steps.size() == 3) watch.cancel();
  });
  REQUIRE(end.has_value());
  CHECK(end->stopped);
  REQUIRE(some.steps.size() == 3);
  CHECK(some.joints.back() == all.joints[2]);
  CHECK(some.ends.back() == all.ends[2]);
  Handed none;
  Watch before;
  before.cancel();
  CHECK(refusal(live(low_cap(), before, none), Fault::cancelled) != "none");
  CHECK(none.steps.empty());
}

TEST_CASE("a move that is stopped leaves the shell where it was") {
  const auto scene = shared_scene(low_cap());
  const Simulation session = on_its_net(scene, 8);
  const NestedShell& nested = session.shell();
  auto shell = value_of(
      DesignShell::make(*scene, 8, nested.mesh(0), nested.model(0), nested.state().levels[0]));
  const Eigen::Matrix3Xd before = shell->state().x;
  ShellEnds ends = shell->ends();
  ends.leg.array() += 0.3;
  Watch watch;
  watch.cancel();
  for (const bool in_steps : {false, true}) {
    const auto moved =
        in_steps ? shell->move_in_steps(ends, 5, watch) : shell->move(ends, 5, watch);
    CHECK(refusal(moved, Fault::cancelled) != "none");
    CHECK(shell->state().x == before);
  }
}
