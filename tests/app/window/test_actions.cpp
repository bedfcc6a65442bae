// What keys and the buttons of the mouse do.
#include "app/window/actions.h"

#include "tests/app/window/edited_shell.h"

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("a drag with the middle button moves the view, whatever is under the mouse") {
  for (const Over over : {Over::nothing, Over::joint, Over::edge_point})
    CHECK(gesture_of(Button::middle, over, false) == Gesture::pan);
}

TEST_CASE("a key without effect on this shell says why") {
  ViewerState viewer({});
  viewer.shell = std::make_shared<const ShellView>(EditedShell().view());
  find_action("net")->perform(viewer);
  CHECK(viewer.message == "this shell was not designed on a net");
  CHECK_FALSE(viewer.show.net);
  find_action("soft_mode")->perform(viewer);
  CHECK(viewer.message == "the shell is stable");
  CHECK_FALSE(viewer.animate_mode);
  // what moved an unstable shell can still be switched off
  viewer.animate_mode = true;
  find_action("soft_mode")->perform(viewer);
  CHECK_FALSE(viewer.animate_mode);
}
