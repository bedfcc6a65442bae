#include "app/window/view_hand.h"

#include <catch2/catch.hpp>

#include "render/draw/camera.h"

using namespace gridshell;
using namespace gridshell::window;

namespace {

/// A flat cell of 20 mm with a rod along each side, seen from above; node k at its corner k.
std::shared_ptr<const Sight> one_cell() {
  auto layout = std::make_shared<record::Layout>();
  layout->joints.resize(4);
  layout->cells.push_back({0, 0, 10, 10, {0, 1, 2, 3}});
  layout->rods = {{0, 1}, {3, 2}, {0, 3}, {1, 2}};
  auto sight = std::make_shared<Sight>();
  sight->layout = layout;
  sight->frame.nodes.resize(3, 4);
  sight->frame.nodes << 0, 20, 20, 0, 0, 0, 20, 20, 0, 0, 0, 0;
  sight->normals = Eigen::Matrix3Xd::Zero(3, 4);
  return sight;
}

}  // namespace

TEST_CASE("a click shows a joint, a rod with the nearest of its nodes, or a cell") {
  Desk desk({});
  desk.sight = one_cell();
  desk.view = {800, 800};
  look_from(desk.camera, view_top);
  fit(desk.camera, desk.view, desk.sight->frame.nodes);
  ViewHand hand(desk);
  const auto click = [&](double x, double y) {
    const Eigen::Vector2d at = render::to_pixel(desk.camera, 800, 800, {x, y, 0});
    hand.press(Button::left, false, at.x(), at.y());
    hand.release(at.x(), at.y());
  };
  click(20, 0);
  CHECK(desk.picked_joint == 1);
  CHECK(desk.picked_rod.rod == -1);
  CHECK(desk.picked_cell == -1);
  click(20, 14);
  CHECK(desk.picked_joint == -1);
  CHECK(desk.picked_rod.rod == 3);
  CHECK(desk.picked_rod.point == 1);
  CHECK(desk.picked_cell == -1);
  click(6, 0);
  CHECK(desk.picked_rod.rod == 0);
  CHECK(desk.picked_rod.point == 0);
  click(10, 10);
  CHECK(desk.picked_joint == -1);
  CHECK(desk.picked_rod.rod == -1);
  CHECK(desk.picked_cell == 0);
}
