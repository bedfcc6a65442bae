#include "app/window/worker_threads.h"

#include "tests/app/window/edited_shell.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("the thread executes every command, and the latest of a drag") {
  const auto dragged = [](int commands) {
    EngineThread engine;
    engine.post({Open{small_shell()}});
    // the thread forms the shell for longer than it takes to post these
    for (int k = 1; k <= commands; ++k) engine.post({Move{1 - 0.2 * k / commands}, 3, true});
    engine.post({RefineAfterDrag{}, 3, false});
    engine.wait();
    REQUIRE(engine.shell()->any());
    CHECK(engine.shell()->progress == Approx(0.8));
    CHECK(engine.shell()->refined);
    CHECK(engine.shell()->undo_steps == 1);
    return engine.shell()->equilibria;
  };
  const int of_one = dragged(1);
  CHECK(dragged(1000) < of_one + 500);
}

TEST_CASE("a cancel stops a command in a certified state, and the next one is executed") {
  EngineThread engine;
  engine.post({Open{small_shell()}});
  engine.wait();
  engine.post({Move{0.1}});
  engine.cancel();
  engine.wait();
  CHECK(engine.idle());
  CHECK(engine.shell()->progress > 0.11);
  CHECK(engine.shell()->certificate.residual_N < 1e-5);
  engine.post({Move{0.9}});
  engine.wait();
  CHECK(engine.shell()->progress == Approx(0.9));
}
