#include <catch2/catch.hpp>

#include "render/movie/run_figures.h"
#include "tests/render/movie/fake_renderer.h"
#include "tests/render/synthetic.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

record::Trajectory pushed() {
  record::Trajectory run = synthetic::dome(3, 2);
  for (int k = 0; k < 3; ++k) {
    record::Frame& frame = run.frames.edit()[std::size_t(k)];
    frame.depth_mm = 2 * k;
    frame.force_N = 0.1 * k * k;
    frame.event.clear();
    frame.K_bins.resize(2, 3);
    frame.K_bins << 0.01 * k, 0.002, 8, 0.02, 0.004, 9;
  }
  return run;
}

}  // namespace

TEST_CASE("the force of a push is plotted over all its frames, N over mm") {
  const record::Trajectory run = pushed();
  const Plot plot = force_plot({{&run, "inward"}});
  REQUIRE(plot.series.size() == 1);
  CHECK(plot.series[0].x == std::vector<double>{0, 2, 4});
  CHECK(plot.series[0].y[2] == Approx(0.4));
  CHECK(plot.x.label.find("mm") != std::string::npos);
  CHECK(plot.y.label.find("N") != std::string::npos);
}

TEST_CASE("a snap is a dashed line from the state before to the one after, with its name once") {
  record::Trajectory run = pushed();
  record::Frame snapped = run.frames[2];
  snapped.event = "snap at depth 3.1 mm";
  run.frames.back() = snapped;
  const Plot plot = force_plot({{&run, "a"}, {&run, "b"}});
  REQUIRE(plot.series.size() == 4);
  const Series &way = plot.series[0], &snap = plot.series[1];
  REQUIRE(way.y.size() == 4);
  CHECK(std::isnan(way.y[2]));
  CHECK(snap.dash.size() == 2);
  CHECK((snap.x[0] == 2 && snap.x[1] == 4));
  CHECK((snap.y[0] == Approx(0.1) && snap.y[1] == Approx(0.4)));
  CHECK(snap.name == "snap to another state");
  CHECK(plot.series[3].name.empty());
}

TEST_CASE(
    "pushed shells stand beside one another, and their bins are written where they are known") {
  const TemporaryFolder folder;
  const record::Trajectory run = pushed();
  test::FakeRenderer renderer;
  Watch watch;
  MovieStyle style;
  style.width = 160;
  style.height = 120;
  const auto image =
      draw_pushes({{&run, "a"}, {&run, "b"}}, style, renderer, watch).and_then(draw_panels);
  REQUIRE(image);
  CHECK(image->width > 240);
  REQUIRE(write_push_bins(folder.path() / "bins", {{&run, "a"}, {&run, "b"}}, "Two pushes"));
  CHECK(std::filesystem::exists(folder.path() / "bins.png"));
  CHECK(std::filesystem::exists(folder.path() / "bins.svg"));
}
