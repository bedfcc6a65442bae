#include "render/movie/framing.h"

#include <algorithm>
#include <cmath>

#include "render/movie/run_summary.h"
#include "tests/presets.h"
#include "tests/render/synthetic.h"

using namespace gridshell;
using namespace gridshell::render;

TEST_CASE("the whole run stays within the view over the whole turn, and fills it") {
  const record::Trajectory run = synthetic::dome(8, 4);
  const Eigen::Matrix3Xd points = summarise_run(run).bounds();
  for (const auto& [width, height] : {std::pair{1280, 720}, {320, 240}, {600, 1200}})
    for (double elevation : {0.0, 22.0, 60.0, 90.0})
      for (double turn : {0.0, 40.0, -360.0}) {
        MovieStyle style;
        style.size = {width, height};
        style.elevation_deg = elevation;
        style.turn_deg = turn;
        // a view off the picture's middle, as captions leave it
        const Box view{0.05 * width, 0.2 * height, 0.6 * width, 0.7 * height};
        const Framing framing(points, style, view);
        INFO(width << " x " << height << " elevation " << elevation << " turn " << turn);
        double x0 = 1e9, x1 = -1e9, y0 = 1e9, y1 = -1e9;
        for (std::size_t k = 0; k < run.frames.size(); ++k) {
          const Camera camera = framing.camera(double(k) / double(run.frames.size() - 1));
          for (const Eigen::Matrix3Xd& set : {run.frames[k].nodes, run.layout.original_boundary})
            for (long n = 0; n < set.cols(); ++n) {
              const Eigen::Vector2d p = to_pixel(camera, width, height, set.col(n));
              x0 = std::min(x0, p.x()), x1 = std::max(x1, p.x());
              y0 = std::min(y0, p.y()), y1 = std::max(y1, p.y());
            }
        }
        // the fit to round points is exact to a hundredth
        const double slack = 0.01 * std::max(view.width, view.height);
        CHECK(view.inset(-slack).contains({x0, y0, x1 - x0, y1 - y0}));
        CHECK(std::max((x1 - x0) / view.width, (y1 - y0) / view.height) > 0.93);
        CHECK(framing.seen().inset(-slack).contains({x0, y0, x1 - x0, y1 - y0}));
      }
}

TEST_CASE("the camera turns evenly about one target and keeps its distance") {
  const record::Trajectory run = synthetic::dome(4, 2);
  MovieStyle style;
  style.azimuth_deg = 10;
  style.turn_deg = 80;
  const Framing framing(summarise_run(run).bounds(), style, {0, 0, 1280, 720});
  const Camera first = framing.camera(0), middle = framing.camera(0.5), last = framing.camera(1);
  CHECK(first.azimuth_deg == Approx(10));
  CHECK(middle.azimuth_deg == Approx(50));
  CHECK(last.azimuth_deg == Approx(90));
  CHECK(first.half_extent_mm == last.half_extent_mm);
  CHECK(first.elevation_deg == last.elevation_deg);
}

TEST_CASE("zoom and target are about the panel, wherever it is") {
  const record::Trajectory run = synthetic::dome(4, 2);
  const Box panel{300, 50, 400, 600};
  const auto points = summarise_run(run).bounds();
  MovieStyle style;
  const Framing plain(points, style, panel);
  // the point in the panel's middle
  const Camera before = plain.camera(0);
  const CameraAxes axes = camera_axes(before);
  const double mm = 1 / plain.pixels_per_mm();
  const Eigen::Vector3d middle = before.target + mm * (panel.middle().x - 640) * axes.right -
                                 mm * (panel.middle().y - 360) * axes.up;
  style.zoom = 3;
  const Framing near(points, style, panel);
  CHECK(near.pixels_per_mm() == Approx(3 * plain.pixels_per_mm()));
  const Eigen::Vector2d after = to_pixel(near.camera(0), 1280, 720, middle);
  CHECK(after.x() == Approx(panel.middle().x).margin(1));
  CHECK(after.y() == Approx(panel.middle().y).margin(1));
  style.target_mm = {20, -30, 10};
  for (const bool orthographic : {false, true}) {
    style.orthographic = orthographic;
    const Eigen::Vector2d at =
        to_pixel(Framing(points, style, panel).camera(0), 1280, 720, Eigen::Vector3d(20, -30, 10));
    CHECK(at.x() == Approx(panel.middle().x).margin(0.01));
    CHECK(at.y() == Approx(panel.middle().y).margin(0.01));
  }
}

TEST_CASE("a bar of pixels_per_mm is true in the plane through the target") {
  const record::Trajectory run = synthetic::dome(4, 2);
  const Framing framing(summarise_run(run).bounds(), MovieStyle{}, {100, 100, 800, 500});
  const Camera camera = framing.camera(0.3);
  const CameraAxes axes = camera_axes(camera);
  const Eigen::Vector2d a = to_pixel(camera, 1280, 720, camera.target);
  const Eigen::Vector2d b = to_pixel(camera, 1280, 720, camera.target + 20 * axes.right);
  CHECK((b - a).norm() == Approx(20 * framing.pixels_per_mm()));
}
