#include "app/window/worker_threads.h"

#include <catch2/catch.hpp>
#include <chrono>

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("work beside the window tells how far it is, and how it ended, once") {
  BackgroundTask work;
  CHECK(work.idle());
  work.begin(
      [](const ProgressListener& heard, const Watch&) -> Result<void> {
        heard("50 %  drawing");
        return {};
      },
      "out/shell.png");
  work.wait();
  CHECK_FALSE(work.under_way());
  CHECK_FALSE(work.idle());
  CHECK(work.standing() == "50 %  drawing");
  const auto end = work.take_end();
  REQUIRE(end);
  CHECK(end->made);
  CHECK(end->target == "out/shell.png");
  CHECK_FALSE(work.take_end());
  CHECK(work.idle());
}

TEST_CASE("work beside the window stops when it is asked to, and when the window goes") {
  const auto endless = [](const ProgressListener& heard, const Watch& watch) -> Result<void> {
    while (!watch.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    heard("the frames so far are kept");
    return stopped();
  };
  BackgroundTask work;
  work.begin(endless, "out/shell");
  CHECK(work.under_way());
  work.stop();
  work.wait();
  const auto end = work.take_end();
  REQUIRE(end);
  CHECK(end->made.error().fault == Fault::cancelled);
  CHECK(end->last_words == "the frames so far are kept");
  work.begin(endless, "out/shell");
}
