#include "render/gl/laths.h"

#include <catch2/catch.hpp>

#include "tests/render/gl/picture.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

/// A lath along y, 20 wide and 4 thick, that a short one crosses in the plane z = 0.
record::Layout crossed_laths() {
  record::Layout layout;
  layout.spacing_mm = layout.length_scale_mm = 100;
  layout.rod_diameter_mm = 10;
  layout.rods = {{0, 1, 2}, {3, 1, 4}};
  layout.joints = {{0, 0, 0, 0, 1}};
  return layout;
}

Drawing drawing_of(const record::Layout& layout) {
  Drawing drawing;
  drawing.layout = &layout;
  drawing.nodes.resize(3, 5);
  drawing.nodes << 0, 0, 0, -1, 1, -50, 0, 50, 0, 0, 0, 0, 0, 0, 0;
  drawing.laths_mm = {20, 4, 20, 4};
  drawing.joint_diameter_mm = 0;
  drawing.ground = false;
  drawing.rod_colour = {0, 0, 0, 1};
  drawing.rod_diameter_mm = 10;
  return drawing;
}

/// How many rows of a picture are dark in the column at `x`.
int dark_rows(const Image& image, int x) {
  int count = 0;
  for (int y = 0; y < image.height; ++y) count += image.pixel(x, y)[0] < 128;
  return count;
}

}  // namespace

TEST_CASE("a lath is as wide as its width from above, and as its thickness on its edge") {
  auto studio = test::studio();
  REQUIRE(studio);
  const record::Layout layout = crossed_laths();
  const Drawing drawing = drawing_of(layout);
  Camera camera;
  camera.field_of_view_deg = 0;
  camera.half_extent_mm = 50;  // a pixel is half a millimetre
  camera.azimuth_deg = 0;
  const auto seen = [&](double elevation_deg) {
    camera.elevation_deg = elevation_deg;
    const auto image = studio->renderer->draw(drawing, camera, {2, false, 1}, 200, 200);
    REQUIRE(image);
    return dark_rows(*image, 40);
  };
  CHECK(seen(0) == Approx(8).margin(1));
  camera.azimuth_deg = 0.001;  // from above, with y across the picture
  CHECK(seen(89.9) == Approx(40).margin(1));
  CHECK(seen(45) == Approx((20 + 4) / std::sqrt(2.0) * 2).margin(2));
}

TEST_CASE("the normal of a lath is the shell's at its joints, at right angles to it elsewhere") {
  const record::Layout layout = crossed_laths();
  Drawing drawing = drawing_of(layout);
  drawing.nodes(2, 0) = drawing.nodes(2, 2) = -30;
  const auto normals = lath_normals(drawing, 0, shell_normals(drawing));
  REQUIRE(normals.size() == 3);
  CHECK(std::abs(normals[1].z()) == Approx(1));
  for (const int end : {0, 2}) {
    const Eigen::Vector3f along =
        (drawing.nodes.col(end) - drawing.nodes.col(1)).cast<float>().normalized();
    CHECK(normals[std::size_t(end)].dot(along) == Approx(0).margin(1e-5));
    CHECK(normals[std::size_t(end)].dot(normals[1]) > 0.8);
  }
}

TEST_CASE("rods that are drawn as round, or are, have no lath") {
  const record::Layout layout = crossed_laths();
  Drawing drawing = drawing_of(layout);
  CHECK(lath_size(drawing, 0) == Eigen::Vector2f(20, 4));
  drawing.laths_mm.clear();
  CHECK(lath_size(drawing, 0) == Eigen::Vector2f(0, 0));
}

TEST_CASE("rods become laths with bolts half as wide, and joints that are not drawn no bolts") {
  const record::Layout layout = crossed_laths();
  Drawing drawing = drawing_of(layout);
  drawing.laths_mm.clear();
  drawing.joint_diameter_mm = 3;
  const Drawing round = drawing;
  put_laths({}, drawing);
  CHECK((drawing.joint_diameter_mm == 3 && drawing.rod_colour == round.rod_colour));
  put_laths({20, 4, 16, 4}, drawing);
  CHECK(drawing.laths_mm == std::vector<double>{20, 4, 16, 4});
  CHECK(drawing.joint_diameter_mm == 10);
  CHECK(drawing.rod_colour != round.rod_colour);
  drawing.joint_diameter_mm = 0;
  put_laths({20, 4}, drawing);
  CHECK(drawing.joint_diameter_mm == 0);
}
