// The scratch file that stores states to undo, and work in the background.
#include <chrono>
#include <cmath>

#include "app/window/edit_session.h"
#include "app/window/worker_threads.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("bytes put aside come back, in any order and once more") {
  ScratchFile file;
  const std::string words = "of a step", numbers(1 << 20, char(200));
  const auto a = file.put(words), b = file.put(""), c = file.put(numbers);
  REQUIRE((a && b && c));
  CHECK(file.bytes() == std::int64_t(words.size() + numbers.size()));
  for (int turn = 0; turn < 2; ++turn) {
    CHECK(file.take(*c) == numbers);
    CHECK(file.take(*b).empty());
    CHECK(file.take(*a) == words);
  }
  CHECK(file.take({file.bytes(), 8}).empty());
}

TEST_CASE("work in the background reports how far it is, and how it ended, once") {
  BackgroundTask work;
  CHECK(work.idle());
  work.begin(
      [](const ProgressListener& listener, const Watch&) -> Result<void> {
        listener("50 %  drawing");
        return {};
      },
      "out/shell.png");
  work.wait();
  CHECK_FALSE(work.under_way());
  CHECK_FALSE(work.idle());
  CHECK(work.progress_text() == "50 %  drawing");
  const auto end = value_of(work.take_end());
  CHECK(end.made);
  CHECK(end.target == "out/shell.png");
  CHECK_FALSE(work.take_end());
  CHECK(work.idle());
}

TEST_CASE("work in the background stops on request, and when the window closes") {
  const auto endless = [](const ProgressListener& listener, const Watch& watch) -> Result<void> {
    while (!watch.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    listener("the frames so far are kept");
    return stopped();
  };
  BackgroundTask work;
  work.begin(endless, "out/shell");
  CHECK(work.under_way());
  work.stop();
  work.wait();
  const auto end = value_of(work.take_end());
  CHECK(end.made.error().fault == Fault::cancelled);
  CHECK(end.last_words == "the frames so far are kept");
  work.begin(endless, "out/shell");
}
