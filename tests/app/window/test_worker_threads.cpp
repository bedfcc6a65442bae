#include "app/window/worker_threads.h"

#include "tests/app/window/edited_shell.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("the thread executes every command, and the latest of a drag") {
  EngineThread engine;
  engine.post({Open{small_shell()}});
  engine.wait();
  REQUIRE(engine.shell()->any());
  CHECK(engine.shell()->refined);
  for (int k = 1; k <= 50; ++k) engine.post({Move{1 - 0.004 * k}, 3, true});
  engine.post({RefineAfterDrag{}, 3, false});
  engine.wait();
  CHECK(engine.shell()->progress == Approx(0.8));
  CHECK(engine.shell()->refined);
  CHECK(engine.shell()->undo_steps == 1);
  // at most one equilibrium per command, fewer on a slow machine
  CHECK(engine.shell()->equilibria <= 60);
}

TEST_CASE("a cancel stops the thread and keeps a certified state") {
  EngineThread engine;
  engine.post({Open{small_shell()}});
  engine.wait();
  engine.post({Move{0.1}});
  engine.cancel();
  engine.wait();
  CHECK(engine.idle());
  CHECK(engine.shell()->certificate.residual_N < 1e-5);
}
