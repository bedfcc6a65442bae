#include "render/movie/stage.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "render/gl/renderer.h"
#include "tests/render/gl/picture.h"
#include "tests/render/movie/fake_renderer.h"
#include "tests/render/synthetic.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::render;

TEST_CASE("what lies behind the shell is hidden, what lies before it is not") {
  const auto run = synthetic::dome(2, 4);
  Drawing drawing = render::test::dome_drawing(run);
  drawing.far_fade = 1;
  Camera above;
  above.elevation_deg = 90;
  const auto shown = [&](const Eigen::Vector3d& at) {
    Eigen::Matrix3Xd points(3, 3);
    points << 0, 8, 0, 0, 0, 8, 0, 0, 0;
    drawing.rings = {{points.colwise() + at, 2, {1, 0, 0, 1}}};
    const Image image = *draw_picture(400, 400, 1, white, [&](Canvas& canvas) {
      draw_shell_lines(canvas, {0, 0, 400, 400}, drawing, above);
    });
    int red = 0;
    for (std::size_t k = 0; k < image.rgba.size(); k += 4)
      red += image.rgba[k] > 200 && image.rgba[k + 1] < 40 && image.rgba[k + 2] < 40;
    return red > 0;
  };
  CHECK_FALSE(shown({0, 0, 10}));
  CHECK(shown({0, 0, 100}));
  CHECK(shown({120, 0, 0}));
}

TEST_CASE("a shell of lines has fewer, or fainter, of them where it hides them") {
  const auto run = synthetic::dome(2, 4);
  Drawing drawing = render::test::dome_drawing(run);
  drawing.rod_colour = {0, 0, 0, 1};
  drawing.joint_diameter_mm = 0;
  drawing.cell_colours.clear();
  drawing.rings.clear();
  Camera side;
  side.elevation_deg = 10;
  const auto ink = [&] {
    const Image image = *draw_picture(400, 300, 1, {1, 1, 1, 1}, [&](Canvas& canvas) {
      draw_shell_lines(canvas, {0, 0, 400, 300}, drawing, side);
    });
    double dark = 0;
    for (std::size_t k = 0; k < image.rgba.size(); k += 4) dark += 255 - image.rgba[k];
    return dark;
  };
  drawing.far_fade = 0.25;
  const double faded = ink();
  drawing.far_fade = 1;
  const double removed = ink();
  CHECK(removed < 0.95 * faded);
  CHECK(removed > 0.3 * faded);
  // without cells nothing hides anything
  record::Layout open = run.layout;
  open.cells.clear();
  drawing.layout = &open;
  drawing.cell_colours.clear();
  CHECK(ink() > removed);
}

TEST_CASE("an arrow along the view is a ring with a cross or a dot in it") {
  record::Layout layout;
  layout.spacing_mm = 20;
  Drawing drawing;
  drawing.layout = &layout;
  drawing.nodes.resize(3, 0);
  Camera above;
  above.elevation_deg = 90;
  above.half_extent_mm = 50;
  // the ink in the ring, between its middle and its edge
  const auto ink_at = [&](double from_z, double to_z, double x, double y) {
    drawing.arrows = {{{0, 0, from_z}, {0, 0, to_z}, 2, {0, 0, 0, 1}}};
    const Image image = *draw_picture(100, 100, 4, {1, 1, 1, 1}, [&](Canvas& canvas) {
      draw_shell_lines(canvas, {0, 0, 100, 100}, drawing, above);
    });
    return 255 - image.pixel(int(4 * (50 + x)), int(4 * (50 + y)))[0];
  };
  for (const auto& [from, to] : {std::pair(20.0, 0.0), {0.0, 20.0}}) {
    CHECK(ink_at(from, to, 0, 0) > 200);
    CHECK(ink_at(from, to, 6.4, 0) > 200);  // the ring
    CHECK(ink_at(from, to, 3.6, 0) < 50);
  }
  CHECK(ink_at(20, 0, 3, 3) > 200);  // into the picture
  CHECK(ink_at(0, 20, 3, 3) < 50);
}

TEST_CASE("coloured cells are filled in lines, under the rods that are seen") {
  const record::Trajectory run = synthetic::dome(3, 2);
  MovieStyle style;
  style.elevation_deg = 90;
  style.colour_by = ColourBy::K;
  const Stage stage(run, style);
  const Drawing drawing = stage.drawing(run.frames[2]);
  REQUIRE(drawing.cell_colours.size() == run.layout.cells.size());
  const Image picture = value_of(draw_picture(400, 400, 1, white, [&](Canvas& canvas) {
    draw_shell_lines(canvas, {0, 0, 400, 400}, drawing, stage.camera(2));
  }));
  Camera camera = stage.camera(2);
  const record::Cell& cell = run.layout.cells[0];
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const int joint : cell.joints)
    middle += 0.25 * drawing.nodes.col(run.layout.joints[std::size_t(joint)].node);
  const Eigen::Vector2d at = to_pixel(camera, 400, 400, middle);
  const auto pixel = picture.pixel(int(at.x()), int(at.y()));
  CHECK(std::abs(pixel[0] / 255.0 - drawing.cell_colours[0].r) < 0.02);
  CHECK(std::abs(pixel[2] / 255.0 - drawing.cell_colours[0].b) < 0.02);
}

TEST_CASE("a push along the view has a sign in pictures too") {
  record::Trajectory run = synthetic::dome(3, 2);
  run.layout.loaded_joints = {{3, -Eigen::Vector3d::UnitZ()}};
  for (const double elevation : {90.0, 20.0}) {
    MovieStyle style;
    style.size = {640, 480};
    style.elevation_deg = elevation;
    for (const bool two : {false, true}) {
      style.views = {};
      if (two) style.views = {{0, elevation}};
      gridshell::test::FakeRenderer renderer;
      const Stage stage(run, style);
      const Image picture = value_of(stage.draw_views(renderer, {run.frames[2], 2}));
      // the sign is white inside, which nothing else in the views is
      const Box& view = stage.layout().view;
      int white = 0;
      for (int y = int(view.y) + 2; y < int(view.bottom()) - 2; ++y)
        for (int x = int(view.x) + 2; x < int(view.right()) - 2; ++x)
          white += picture.pixel(x, y)[0] == 255;
      CHECK((white > 0) == (elevation == 90));
    }
  }
}
