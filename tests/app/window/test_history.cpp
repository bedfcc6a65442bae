// Numbers put aside for steps to undo, and work beside the window.
#include <chrono>
#include <cmath>

#include "app/window/edit_session.h"
#include "app/window/worker_threads.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("numbers put aside come back to the bit, in any order") {
  ScratchFile file;
  Eigen::Matrix3Xd places = Eigen::Matrix3Xd::Random(3, 5);
  places(1, 2) = std::nextafter(1.0, 2.0);
  Eigen::VectorXd none, forces = Eigen::VectorXd::Random(7);
  const Eigen::Matrix3Xd places_before = places;
  const Eigen::VectorXd forces_before = forces;
  SavedArray a, b, c;
  REQUIRE((file.put(places, a) && file.put(none, b) && file.put(forces, c)));
  CHECK(places.size() + forces.size() == 0);
  CHECK(file.bytes() == 8 * (15 + 7));
  REQUIRE((file.take(c, forces) && file.take(b, none) && file.take(a, places)));
  CHECK(places == places_before);
  CHECK(forces == forces_before);
  CHECK(none.size() == 0);
  // and once more
  REQUIRE(file.take(c, forces));
  CHECK(forces == forces_before);
}

TEST_CASE("work beside the window tells how far it is, and how it ended, once") {
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
  CHECK(work.standing() == "50 %  drawing");
  const auto end = value_of(work.take_end());
  CHECK(end.made);
  CHECK(end.target == "out/shell.png");
  CHECK_FALSE(work.take_end());
  CHECK(work.idle());
}

TEST_CASE("work beside the window stops when it is asked to, and when the window goes") {
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
