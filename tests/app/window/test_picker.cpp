// What is picked, measured or dragged while another shell comes.
#include "app/window/actions.h"
#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::window;

namespace {

/// Waits for the engine, and shows its shell.
void show(ViewerState& viewer) {
  viewer.engine.wait();
  viewer.tick(0.01);
  REQUIRE(viewer.shell->any());
}

}  // namespace

TEST_CASE("of a shell with other joints nothing is picked or measured") {
  ViewerState viewer({});
  viewer.view = {800, 600};
  viewer.open(circle(6, 66, 54));
  show(viewer);
  const int joints = int(viewer.shell->layout->joints.size());
  viewer.measure(joints - 1);
  viewer.measure(joints - 2);
  viewer.picked_joint = joints - 1;
  // another state of the same shell changes none of it
  viewer.post(Move{0.9}, false);
  show(viewer);
  CHECK(viewer.measured.size() == 2);
  preset::Preset fewer = viewer.shell->preset;
  fewer.footprint.rods = 4;
  viewer.post(Change{fewer}, false);
  show(viewer);
  REQUIRE(int(viewer.shell->layout->joints.size()) < joints);
  CHECK(viewer.measured.empty());
  CHECK(viewer.picked_joint == -1);
}

TEST_CASE("a drag ends if its joint is gone") {
  ViewerState viewer({});
  viewer.view = {800, 600};
  viewer.open(circle(6, 66, 54));
  show(viewer);
  viewer.look(render::view_top);
  const int last = int(viewer.shell->layout->joints.size()) - 1;
  Picker picker(viewer);
  const Eigen::Vector2d at =
      render::to_pixel(viewer.camera, 800, 600, viewer.shell->frame.nodes.col(last));
  picker.hover(at.x(), at.y());
  REQUIRE(viewer.joint_under == last);
  picker.press(Button::left, false, at.x(), at.y());
  preset::Preset fewer = viewer.shell->preset;
  fewer.footprint.rods = 4;
  viewer.post(Change{fewer}, false);
  show(viewer);
  REQUIRE(int(viewer.shell->layout->joints.size()) <= last);
  const int before = viewer.shell->equilibria;
  picker.drag(at.x() + 20, at.y() + 20);
  picker.drag(at.x() + 40, at.y() + 40);
  picker.release(at.x() + 40, at.y() + 40);
  show(viewer);
  CHECK(viewer.shell->error.empty());
  CHECK(viewer.shell->constrained.empty());
  CHECK(viewer.shell->equilibria == before);
}
