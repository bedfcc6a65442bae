// What the buttons of the mouse do.
#include "app/window/actions.h"

#include <catch2/catch.hpp>

using namespace gridshell::window;

TEST_CASE("a drag with the middle button moves the view, whatever is under the mouse") {
  for (const Over over : {Over::nothing, Over::joint, Over::edge_point})
    CHECK(gesture_of(Button::middle, over, false) == Gesture::pan);
}
