// What happens between the end of a branch and the way down from it.
#include "engine/simulate/branch_switch.h"

#include <catch2/catch.hpp>

#include "engine/solve/buckling.h"

using namespace gridshell;

TEST_CASE("a state is carried on with its boundary, near to the energy of its branch") {
  preset::Preset asked;
  asked.footprint.rods = 6;
  asked.footprint.radius_mm = 66;
  asked.actuation.radius_mm = 53;
  const Scene scene = scene_of(asked).value();
  NestedShell shell =
      NestedShell::make(scene.footprint, scene.rods, RodModel::bend, scene.motion, {{4}, false}, {})
          .value();
  const Watch watch;
  Linearisation& system = shell.system(0);
  const PinnedMotion& motion = shell.motion(0);
  const double begin = 0.3, end = 0.6, there = 0.61;
  shell.place(begin,
              first_buckled(system, shell.mesh(0), motion, begin, {}, scene.flat, watch).value());
  REQUIRE(shell.advance(end, watch).end == Outcome::reached);
  const PathPoint& last = shell.followed();
  const double energy = system.energy_at(last.state);
  const double d = scene.footprint.spacing;

  State alone = last.state;
  motion.impose(system, there, alone);
  CHECK(system.energy_at(alone) > 10 * energy);

  const State free = extrapolated_state(system, motion, last, there, 0.2 * d, watch);
  CHECK(system.energy_at(free) < 2 * energy);
  const double moved = max_column_norm(free.x - last.state.x);
  CHECK(moved <= 0.2 * d);

  // held back by a shift, and where nothing serves moved by what is prescribed alone
  const double near = 0.7 * moved;
  const State held = extrapolated_state(system, motion, last, there, near, watch);
  CHECK(max_column_norm(held.x - last.state.x) <= near);
  CHECK(system.energy_at(held) > system.energy_at(free));
  CHECK(system.energy_at(held) < system.energy_at(alone));
  CHECK(extrapolated_state(system, motion, last, there, 1e-6, watch).x == alone.x);
}
