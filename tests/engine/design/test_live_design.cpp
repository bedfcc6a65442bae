// A design that is watched: its steps as they come, and where it stands when it is stopped.
#include "engine/design/design.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/simulate/simulation.h"

using namespace gridshell;

namespace {

preset::Preset low_cap() {
  preset::Preset p;
  p.footprint.kind = preset::FootprintKind::net;
  p.footprint.placement = preset::Placement::on_axis;
  p.net.radius_mm = 120;
  p.net.cut_height = 0.7;
  p.actuation.start = preset::Start::net;
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
  auto made = scene_of(preset);
  REQUIRE(made.has_value());
  const auto scene = std::make_shared<const Scene>(std::move(*made));
  auto session = Simulation::open(scene, plan_of_mesh(8));
  REQUIRE(session.has_value());
  REQUIRE(session->begin_on_net(unwatched).has_value());
  const NestedShell& shell = session->shell();
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
  const auto end = live(low_cap(), unwatched, handed);
  REQUIRE(end.has_value());
  CHECK_FALSE(end->stopped);
  REQUIRE(handed.steps.size() > 3);
  CHECK(handed.steps.front().iteration == 0);
  CHECK(handed.steps.back().max_mm < 0.35 * handed.steps.front().max_mm);
  for (const DesignStep& step : handed.steps) CHECK(step.taken);
  // it comes to what the design that nobody watches does
  Watch watch;
  const auto whole = design(low_cap(), watch);
  REQUIRE(whole.has_value());
  CHECK(handed.steps.back().max_mm == Approx(whole->after.front().max_mm).epsilon(1e-4));
  REQUIRE(end->rounded_max_mm.has_value());
  CHECK(*end->rounded_max_mm == Approx(whole->rounded->max_mm).epsilon(1e-3));
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
  const auto refused = live(low_cap(), before, none);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().fault == Fault::cancelled);
  CHECK(none.steps.empty());
}

TEST_CASE("a move that is stopped leaves the shell where it was") {
  auto made = scene_of(low_cap());
  REQUIRE(made.has_value());
  const auto scene = std::make_shared<const Scene>(std::move(*made));
  auto session = Simulation::open(scene, plan_of_mesh(8));
  REQUIRE(session->begin_on_net(unwatched).has_value());
  const NestedShell& nested = session->shell();
  auto shell =
      DesignShell::make(*scene, 8, nested.mesh(0), nested.model(0), nested.state().levels[0]);
  REQUIRE(shell.has_value());
  const Eigen::Matrix3Xd before = (*shell)->state().x;
  ShellEnds ends = (*shell)->ends();
  ends.leg.array() += 0.3;
  Watch watch;
  watch.cancel();
  for (const bool in_steps : {false, true}) {
    const auto moved =
        in_steps ? (*shell)->move_in_steps(ends, 5, watch) : (*shell)->move(ends, 5, watch);
    REQUIRE_FALSE(moved.has_value());
    CHECK(moved.error().fault == Fault::cancelled);
    CHECK((*shell)->state().x == before);
  }
}
