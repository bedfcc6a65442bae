#include "render/gl/renderer.h"

#include <catch2/catch.hpp>

using namespace gridshell::render;

namespace {

void check_pixel(const Camera& camera, const Eigen::Vector3d& point, double x, double y) {
  const Eigen::Vector2d pixel = to_pixel(camera, 400, 200, point);
  CHECK(pixel.x() == Approx(x).margin(1e-9));
  CHECK(pixel.y() == Approx(y).margin(1e-9));
}

}  // namespace

TEST_CASE("a camera keeps its target in the middle and its half extent at the rim", "[camera]") {
  for (double field_of_view : {0.0, 20.0, 60.0}) {
    Camera camera;
    camera.azimuth_deg = 0;
    camera.elevation_deg = 0;
    camera.target = {3, -2, 5};
    camera.half_extent_mm = 50;
    camera.field_of_view_deg = field_of_view;
    check_pixel(camera, camera.target, 200, 100);
    check_pixel(camera, camera.target + Eigen::Vector3d(0, 0, 50), 200, 0);
    // looking along -x, +y is to the right
    check_pixel(camera, camera.target + Eigen::Vector3d(0, 100, 0), 400, 100);
  }
}

TEST_CASE("from straight above +y is up, whatever the azimuth", "[camera]") {
  for (double azimuth : {0.0, 30.0, 200.0}) {
    Camera camera;
    camera.azimuth_deg = azimuth;
    camera.elevation_deg = 90;
    camera.half_extent_mm = 100;
    check_pixel(camera, {0, 50, 0}, 200, 50);
    check_pixel(camera, {50, 0, 0}, 250, 100);
  }
}

TEST_CASE("what is nearer than the target looks larger, but not to an orthographic camera",
          "[camera]") {
  Camera camera;
  camera.azimuth_deg = camera.elevation_deg = 0;
  const auto above_middle = [&](double nearer) {
    return 100 - to_pixel(camera, 400, 200, {nearer, 0, 50}).y();
  };
  CHECK(above_middle(40) > above_middle(0) + 0.5);
  camera.field_of_view_deg = 0;
  CHECK(above_middle(40) == Approx(above_middle(0)));
}
