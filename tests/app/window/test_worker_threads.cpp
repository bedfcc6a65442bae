#include "app/window/worker_threads.h"

#include <thread>

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

TEST_CASE("a forming that is stopped leaves no shell, or the shell before it, and says so") {
  preset::Preset large = small_shell();
  large.footprint.rods = 24, large.footprint.radius_mm = 260, large.actuation.radius_mm = 195;
  large.accuracy.tolerance = 1e-5;
  EditSession session(std::int64_t(100) << 20);
  // stopped while its first mesh is solved
  const auto stop_forming = [&] {
    Watch watch;
    std::atomic<bool> done = false;
    std::thread user([&] {
      while (watch.position().edges == 0 && !done) std::this_thread::yield();
      watch.cancel();
    });
    session.execute({Open{large}}, watch);
    done = true;
    user.join();
    CHECK(session.shell().error == "stopped");
  };
  stop_forming();
  CHECK_FALSE(session.shell().any());
  session.execute({Move{0.9}}, unwatched);
  CHECK(session.shell().error == "there is no shell yet");
  session.execute({Open{small_shell()}}, unwatched);
  REQUIRE(session.shell().error == "");
  const ShellView before = session.shell();
  stop_forming();
  CHECK(session.shell().frame.nodes == before.frame.nodes);
  CHECK(session.shell().layout == before.layout);
  CHECK(session.shell().undo_steps == before.undo_steps);
  session.execute({Move{0.9}}, unwatched);
  CHECK(session.shell().error == "");
  CHECK(session.shell().progress == Approx(0.9));
}
