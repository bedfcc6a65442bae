#include "app/window/picker.h"

#include <catch2/catch.hpp>

#include "render/gl/renderer.h"

using namespace gridshell;
using namespace gridshell::window;

namespace {

/// A flat cell of 20 mm with a rod along each side, seen from above; node k at its corner k.
std::shared_ptr<const ShellView> one_cell() {
  auto layout = std::make_shared<record::Layout>();
  layout->joints.resize(4);
  layout->cells.push_back({0, 0, 10, 10, {0, 1, 2, 3}});
  layout->rods = {{0, 1}, {3, 2}, {0, 3}, {1, 2}};
  auto sight = std::make_shared<ShellView>();
  sight->layout = layout;
  sight->frame.nodes.resize(3, 4);
  sight->frame.nodes << 0, 20, 20, 0, 0, 0, 20, 20, 0, 0, 0, 0;
  sight->normals = Eigen::Matrix3Xd::Zero(3, 4);
  return sight;
}

}  // namespace

TEST_CASE("a click shows a joint, a rod with the nearest of its nodes, or a cell") {
  ViewerState viewer({});
  viewer.sight = one_cell();
  viewer.view = {800, 800};
  look_from(viewer.camera, view_top);
  fit(viewer.camera, viewer.view, viewer.sight->frame.nodes);
  Picker hand(viewer);
  const auto click = [&](double x, double y) {
    const Eigen::Vector2d at = render::to_pixel(viewer.camera, 800, 800, {x, y, 0});
    hand.press(Button::left, false, at.x(), at.y());
    hand.release(at.x(), at.y());
  };
  click(20, 0);
  CHECK(viewer.picked_joint == 1);
  CHECK(viewer.picked_rod.rod == -1);
  CHECK(viewer.picked_cell == -1);
  click(20, 14);
  CHECK(viewer.picked_joint == -1);
  CHECK(viewer.picked_rod.rod == 3);
  CHECK(viewer.picked_rod.point == 1);
  CHECK(viewer.picked_cell == -1);
  click(6, 0);
  CHECK(viewer.picked_rod.rod == 0);
  CHECK(viewer.picked_rod.point == 0);
  click(10, 10);
  CHECK(viewer.picked_joint == -1);
  CHECK(viewer.picked_rod.rod == -1);
  CHECK(viewer.picked_cell == 0);
}
