// Effects of the mouse on the camera and on what is picked.
#include <catch2/catch.hpp>

#include "app/window/actions.h"
#include "app/window/shell_drawing.h"
#include "render/gl/renderer.h"

using namespace gridshell;
using namespace gridshell::window;

namespace {

const PictureSize size{800, 600};

Eigen::Vector2d pixel(const render::Camera& camera, const Eigen::Vector3d& place) {
  return render::to_pixel(camera, int(size.width), int(size.height), place);
}

}  // namespace

TEST_CASE("what lies under the cursor stays there when the wheel turns") {
  for (double field : {0.0, 20.0}) {
    render::Camera camera;
    camera.field_of_view_deg = field;
    camera.target = {3, -2, 7};
    const render::CameraAxes axes = render::camera_axes(camera);
    // a point in the plane through the target
    const Eigen::Vector3d place = camera.target + 40 * axes.right - 25 * axes.up;
    const Eigen::Vector2d before = pixel(camera, place);
    zoom(camera, size, 3, before.x(), before.y());
    CHECK((pixel(camera, place) - before).norm() < 1e-6);
    CHECK(camera.half_extent_mm < 150);
  }
}

TEST_CASE("the picture goes along with the mouse") {
  render::Camera camera;
  const Eigen::Vector3d place = camera.target;
  const Eigen::Vector2d before = pixel(camera, place);
  pan(camera, size, 30, -20);
  CHECK((pixel(camera, place) - before - Eigen::Vector2d(30, -20)).norm() < 1e-6);
}

TEST_CASE("the elevation ends straight above and straight below") {
  render::Camera camera;
  orbit(camera, 0, 1e4);
  CHECK(camera.elevation_deg == 90);
  orbit(camera, 0, -1e5);
  CHECK(camera.elevation_deg == -90);
}

TEST_CASE("all points lie in the picture that was fitted to them") {
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 300, 20, -5, 0, 10, 90, 40, 0, 5, -30, 80;
  for (const render::ViewDirection& view : {render::view_top, render::view_front, render::view_side,
                                            render::view_corner, render::view_home}) {
    render::Camera camera;
    look_from(camera, view);
    fit(camera, size, points);
    Eigen::Array2d low(size.width, size.height), high(0, 0);
    for (const auto& point : points.colwise()) {
      const Eigen::Vector2d at = pixel(camera, point);
      CHECK((at.x() > 0 && at.x() < size.width && at.y() > 0 && at.y() < size.height));
      low = low.min(at.array());
      high = high.max(at.array());
    }
    // as far from the top as from the bottom, although nearer parts look larger
    CHECK(low.x() == Approx(size.width - high.x()).margin(0.5));
    CHECK(low.y() == Approx(size.height - high.y()).margin(0.5));
  }
}

TEST_CASE("a joint that the shell carries aside is pushed until it is under the cursor") {
  const render::Camera camera;
  const Eigen::Vector3d from(20, 10, 30), axis = Eigen::Vector3d(0.3, -0.2, 0.9).normalized();
  // 4 mm along the push and 3 mm across it
  const Eigen::Vector3d aside = axis.unitOrthogonal(), at = from + 4 * axis + 3 * aside;
  const double deeper = 7;
  const Eigen::Vector2d cursor = pixel(camera, from + deeper * axis + 3 * aside);
  CHECK(pushed_under(camera, size, from, axis, at, cursor - pixel(camera, at)) ==
        Approx(deeper).margin(0.05));
  // seen along the push, the cursor gives no depth, which remains
  const Eigen::Vector3d ahead = render::camera_axes(camera).forward;
  CHECK(pushed_under(camera, size, from, ahead, from + 4 * ahead, {5, 5}) == Approx(4));
}

TEST_CASE("a drag takes a point to where the mouse is") {
  render::Camera camera;
  const Eigen::Vector3d place(20, 10, 30);
  const Eigen::Vector2d before = pixel(camera, place);
  const auto moved = [&](const Eigen::Vector3d& by) -> Eigen::Vector2d {
    return pixel(camera, place + by) - before;
  };
  CHECK((moved(dragged_in_plane(camera, size, place, 8, 5)) - Eigen::Vector2d(8, 5)).norm() < 0.1);
  const Eigen::Vector3d level = dragged_level(camera, size, place, 8, 5);
  CHECK(level.z() == 0);
  CHECK((moved(level) - Eigen::Vector2d(8, 5)).norm() < 0.3);
  const double up = dragged_along(camera, size, place, Eigen::Vector3d::UnitZ(), 0, -9);
  CHECK(std::abs(moved(up * Eigen::Vector3d::UnitZ()).y() + 9) < 0.3);
}

namespace {

/// A flat cell of 20 mm with a rod along each side, seen from above; node k at its corner k.
std::shared_ptr<const ShellView> one_cell() {
  auto layout = std::make_shared<record::Layout>();
  layout->joints.resize(4);
  layout->cells.push_back({0, 0, 10, 10, {0, 1, 2, 3}});
  layout->rods = {{0, 1}, {3, 2}, {0, 3}, {1, 2}};
  auto shell = std::make_shared<ShellView>();
  shell->layout = layout;
  shell->frame.nodes.resize(3, 4);
  shell->frame.nodes << 0, 20, 20, 0, 0, 0, 20, 20, 0, 0, 0, 0;
  shell->normals = Eigen::Matrix3Xd::Zero(3, 4);
  return shell;
}

}  // namespace

TEST_CASE("a click shows a joint, a rod with the nearest of its nodes, or a cell") {
  ViewerState viewer({});
  viewer.shell = one_cell();
  viewer.view = {800, 800};
  look_from(viewer.camera, render::view_top);
  fit(viewer.camera, viewer.view, viewer.shell->frame.nodes);
  Picker picker(viewer);
  const auto click = [&](double x, double y) {
    const Eigen::Vector2d at = render::to_pixel(viewer.camera, 800, 800, {x, y, 0});
    picker.press(Button::left, false, at.x(), at.y());
    picker.release(at.x(), at.y());
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
  // a shell outside of the view cannot be picked
  viewer.view.width = 1;
  picker.hover(2, 400);
  CHECK(viewer.joint_under == -1);
}
