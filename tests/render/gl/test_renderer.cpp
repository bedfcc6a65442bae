#include "render/gl/renderer.h"

#include <cmath>

#include "render/gl/lighting.h"
#include "tests/render/gl/picture.h"
#include "tests/render/synthetic.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

test::Studio open_studio() { return value_of(test::studio()); }

/// The made-up shell at the end of its path, with so many edges per segment.
struct Dome {
  explicit Dome(int edges) : run(synthetic::dome(2, edges)) {}

  test::Studio studio = open_studio();
  record::Trajectory run;
  Drawing drawing = test::dome_drawing(run);
};

Image drawn(test::Studio& studio, const Drawing& drawing, const Camera& camera = {},
            const DrawQuality& quality = {}, int width = 320, int height = 180) {
  return value_of(studio.renderer->draw(drawing, camera, quality, width, height));
}

/// The largest difference of a channel between a pixel and a colour, of 255.
double off(const Image& image, const Eigen::Vector2d& at, const Colour& colour) {
  const std::uint8_t* p = image.pixel(int(at.x()), int(at.y()));
  return std::max({std::abs(p[0] - 255 * colour.r), std::abs(p[1] - 255 * colour.g),
                   std::abs(p[2] - 255 * colour.b)});
}

}  // namespace

TEST_CASE("background, ground and cells show the colours they were given", "[draw]") {
  auto [studio, run, drawing] = Dome(4);
  drawing.ground = false;
  drawing.background = {0.8f, 0.9f, 1};
  const Colour tint{0.25f, 0.45f, 0.8f};
  drawing.cell_colours.assign(run.layout.cells.size(), tint);
  Camera above;
  above.elevation_deg = 90;
  const Image image = drawn(studio, drawing, above);
  CHECK(off(image, {2, 2}, drawing.background) <= 1);
  // without light or shadow: a cell has exactly the colour that the legend shows
  double worst = 0;
  for (const auto& cell : run.layout.cells) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int joint : cell.joints) middle += 0.25 * drawing.nodes.col(run.layout.joints[joint].node);
    worst = std::max(worst, off(image, to_pixel(above, 320, 180, middle), tint));
  }
  CAPTURE(worst);
  CHECK(worst <= 1);
  // nor haze, from the side: where no other cell or rod is in front
  drawing.far_fade = 0.5;
  Camera aside;
  aside.elevation_deg = 50;
  const Image seen = drawn(studio, drawing, aside);
  int alike = 0;
  for (const auto& cell : run.layout.cells) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int joint : cell.joints) middle += 0.25 * drawing.nodes.col(run.layout.joints[joint].node);
    alike += off(seen, to_pixel(aside, 320, 180, middle), tint) <= 1;
  }
  CHECK(alike >= int(0.7 * double(run.layout.cells.size())));

  drawing.cell_colours.clear();
  drawing.background = {1, 1, 1};
  drawing.ground = true;
  Camera grounded;
  grounded.target = {0, 0, drawing.ground_z_mm};
  grounded.elevation_deg = 60;
  const Image with_ground = drawn(studio, drawing, grounded);
  CHECK(off(with_ground, {160, 172}, drawing.ground_colour) <= 2);
}

TEST_CASE("a translucent ghost is drawn over what is behind it and hidden by what is in front",
          "[draw]") {
  auto [studio, run, drawing] = Dome(4);
  drawing.cell_colours.assign(run.layout.cells.size(), {0.25f, 0.45f, 0.8f, 1});
  Camera above;
  above.elevation_deg = 90;
  const Image without = drawn(studio, drawing, above);
  // the shell itself, moved so that a joint is above or below the middle of a cell
  const auto& cell = run.layout.cells[run.layout.cells.size() / 2];
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int joint : cell.joints) middle += 0.25 * drawing.nodes.col(run.layout.joints[joint].node);
  const Eigen::Vector3d aside = middle - drawing.nodes.col(run.layout.joints[cell.joints[0]].node);
  const Eigen::Vector2d at = to_pixel(above, 320, 180, middle);
  for (const double higher_mm : {10.0, -10.0}) {
    CAPTURE(higher_mm);
    const Eigen::Vector3d moved = aside + higher_mm * Eigen::Vector3d::UnitZ();
    drawing.ghosts = {
        {drawing.nodes.colwise() + moved, run.layout.rods, 3, {0.9f, 0.4f, 0.2f, 0.4f}}};
    const Image with = drawn(studio, drawing, above);
    const std::uint8_t *now = with.pixel(int(at.x()), int(at.y())),
                       *before = without.pixel(int(at.x()), int(at.y()));
    if (higher_mm > 0) {
      CHECK(now[0] > before[0] + 30);
      CHECK(now[0] < 255 * 0.9 - 30);
    } else {
      CHECK(std::equal(now, now + 4, before));
    }
  }
}

TEST_CASE("odd sizes, a pixel and many passes are drawn", "[draw][standard]") {
  auto [studio, run, drawing] = Dome(2);
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {333, 211}, {64, 640}}) {
    const Image image = drawn(studio, drawing, {}, {3, true, 1}, width, height);
    CHECK(image.width == width);
    CHECK(image.height == height);
    for (std::size_t k = 3; k < image.rgba.size(); k += 4) REQUIRE(image.rgba[k] == 255);
  }
  const Image once = drawn(studio, drawing, {}, {2, true, 1});
  const Image often = drawn(studio, drawing, {}, {2, true, 12});
  double mean = 0;
  for (std::size_t k = 0; k < once.rgba.size(); ++k)
    mean += std::abs(once.rgba[k] - often.rgba[k]) / double(once.rgba.size());
  CHECK(mean > 0.05);  // softer shadows
  CHECK(mean < 4);     // of the same scene in the same light
}

TEST_CASE("a picture in tiles is the picture in one piece", "[draw]") {
  auto [studio, run, drawing] = Dome(2);
  // 16 samples a side of 400 x 300 pixels take four tiles of 256
  const Image tiled = drawn(studio, drawing, {}, {16, true, 1}, 400, 300);
  const Image whole = drawn(studio, drawing, {}, {8, true, 1}, 400, 300);
  double worst = 0;
  for (int y = 0; y < 300; ++y)
    for (int x : {254, 255, 256, 257})
      for (int c = 0; c < 3; ++c)
        worst = std::max(worst, double(std::abs(tiled.pixel(x, y)[c] - whole.pixel(x, y)[c])));
  CHECK(worst < 24);
}

TEST_CASE("a still of 3840 x 2160 pixels", "[draw][standard]") {
  auto [studio, run, drawing] = Dome(4);
  const Image large = drawn(studio, drawing, {}, {2, true, 1}, 3840, 2160);
  const Image small = drawn(studio, drawing, {}, {8, true, 1}, 960, 540);
  // the means of 4 x 4 pixels are the smaller picture's pixels
  double mean = 0;
  for (int y = 0; y < 540; ++y)
    for (int x = 0; x < 960; ++x) {
      double sum = 0;
      for (int k = 0; k < 16; ++k) sum += large.pixel(4 * x + k % 4, 4 * y + k / 4)[1];
      mean += std::abs(sum / 16 - small.pixel(x, y)[1]) / (960.0 * 540.0);
    }
  CHECK(mean < 1);
}

TEST_CASE("what cannot be drawn is refused with its reason", "[draw]") {
  auto [studio, run, drawing] = Dome(2);
  const auto message = [&](const Drawing& d, const DrawQuality& quality, int width, int height) {
    return refusal(studio.renderer->draw(d, {}, quality, width, height));
  };
  CHECK(message(drawing, {}, 0, 100) ==
        "size: got 0 x 100 pixels, expected 1 to 32767 each and at most 268 million");
  CHECK(message(drawing, {0, true, 1}, 9, 9) == "supersample: got 0, expected 1 to 16");
  CHECK(message(drawing, {1, true, 0}, 9, 9) == "jittered_passes: got 0, expected 1 to 4096");
  CHECK(message(Drawing{}, {}, 9, 9) == "the drawing has no layout");
  Drawing wrong = drawing;
  wrong.nodes(1, 3) = std::nan("");
  CHECK(message(wrong, {}, 9, 9) == "the drawing has a node that is not finite");
  wrong = drawing;
  wrong.cell_colours.pop_back();
  CHECK_THAT(message(wrong, {}, 9, 9), Catch::Contains("cell colours for"));
  wrong = drawing;
  wrong.nodes.conservativeResize(3, 4);
  CHECK_THAT(message(wrong, {}, 9, 9), Catch::Contains("more than its 4 nodes"));
}

namespace {

void check_pixel(const Camera& camera, const Eigen::Vector3d& point, double x, double y) {
  const Eigen::Vector2d pixel = to_pixel(camera, 400, 200, point);
  CHECK(pixel.x() == Approx(x).margin(1e-9));
  CHECK(pixel.y() == Approx(y).margin(1e-9));
}

}  // namespace

TEST_CASE("from straight above +y is up, whatever the azimuth", "[draw]") {
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
          "[draw]") {
  Camera camera;
  camera.azimuth_deg = camera.elevation_deg = 0;
  const auto above_middle = [&](double nearer) {
    return 100 - to_pixel(camera, 400, 200, {nearer, 0, 50}).y();
  };
  CHECK(above_middle(40) > above_middle(0) + 0.5);
  camera.field_of_view_deg = 0;
  CHECK(above_middle(40) == Approx(above_middle(0)));
}

namespace {

/// Mean irradiance on a surface of unit normal n.
double light_on(const std::vector<Lighting>& passes, const Eigen::Vector3d& n) {
  double sum = 0;
  for (const Lighting& l : passes)
    sum += l.key * std::max(0.0, n.dot(l.direction)) + l.sky * 0.5 * (1 + n.z()) +
           l.bounce * 0.5 * (1 - n.z());
  return sum / double(passes.size());
}

}  // namespace

TEST_CASE("level ground in the open receives 1", "[draw]") {
  for (int passes : {1, 2, 7, 64})
    CHECK(light_on(lighting_passes({}, passes), Eigen::Vector3d::UnitZ()) ==
          Approx(1).epsilon(1e-12));
}

TEST_CASE("many passes tend to the light of a single one", "[draw]") {
  const auto one = lighting_passes({}, 1), many = lighting_passes({}, 512);
  for (const Eigen::Vector3d& n :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0.6, 0, 0.8),
        Eigen::Vector3d(0, -0.8, 0.6), Eigen::Vector3d(0, 0, -1)})
    CHECK(light_on(many, n) == Approx(light_on(one, n)).margin(0.04));
  for (const Lighting& l : many) {
    CHECK(l.direction.norm() == Approx(1));
    CHECK(l.direction.z() > 0);
    CHECK(l.pixel_shift.cwiseAbs().maxCoeff() <= 0.5);
  }
}

TEST_CASE("the light turns with the camera", "[draw]") {
  Camera camera;
  camera.azimuth_deg = 0;
  const auto a = lighting_passes(camera, 1)[0].direction;
  camera.azimuth_deg = 90;
  const auto b = lighting_passes(camera, 1)[0].direction;
  CHECK(b.isApprox(Eigen::Vector3d(-a.y(), a.x(), a.z()), 1e-12));
}
