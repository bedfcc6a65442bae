#include "app/window/input_event.h"

#include <catch2/catch.hpp>

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("an event reads back as it was written") {
  for (const char* line :
       {"size 1280 720 1.5", "mouse 12.5 300", "mouse @R_a 0.25 0.5", "mouse @joint:3,-4 0 -20",
        "press left", "release middle", "wheel -2", "down Ctrl", "up F1", "type R a", "do undo",
        "open s1_actuation", "wait 0.25"}) {
    const auto event = read_event(line);
    REQUIRE(event);
    CHECK(write_event(*event) == line);
  }
}

TEST_CASE("a line that is no event is refused with what would be right") {
  for (const char* line : {"", "click 1 2", "mouse 1", "mouse nan 2", "press", "press thumb",
                           "down Hyper", "size 10 10 1", "wait 1e9", "wait -1", "press left now"})
    CHECK_FALSE(read_event(line));
  CHECK(read_event("press thumb").error().message.find("left") != std::string::npos);
}

TEST_CASE("a recording's fault names its line") {
  const auto events = read_events("# a comment\n\nmouse 1 2\r\nmouse one two\n", "visit.txt");
  REQUIRE_FALSE(events);
  CHECK(events.error().message.find("visit.txt:4:") == 0);
  CHECK(read_events("# nothing\n", "visit.txt")->empty());
}
