#include <catch2/catch.hpp>

#include "render/movie/run_plots.h"
#include "tests/render/synthetic.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

record::Trajectory pushed() {
  record::Trajectory run = synthetic::dome(2, 2);
  for (int k = 0; k < 2; ++k) {
    record::Frame& frame = run.frames.edit()[std::size_t(k)];
    frame.K_bins.resize(2, 3);
    frame.depth_mm = k;
    frame.K_bins << 0.03 + 0.01 * k, 0.002 + 0.001 * k, 8, 0.02 - 0.004 * k, 0.004, 9;
  }
  return run;
}

}  // namespace

TEST_CASE("bins show the deviations of both states, next to one another") {
  const record::Trajectory run = pushed();
  const Plot plot = bins_plot(summarise_run(run), 17, run.frames.back(), {}, 8);
  REQUIRE(plot.series.size() == 5);
  const Series &spread = plot.series[1], &now = plot.series[2];
  CHECK(spread.y_error == std::vector<double>{0.002, 0.004});
  CHECK(now.y_error == std::vector<double>{0.003, 0.004});
  CHECK(spread.x[0] < now.x[0]);
  CHECK(plot.series[0].name == "unloaded, mean ± s.d. (left)");
  CHECK(now.name == "loaded, mean ± s.d. (right)");
  CHECK(plot.series[3].name == "mean of all cells, unloaded");
  CHECK(plot.series[4].name == "mean of all cells, loaded");
}

TEST_CASE("bins of a shell that is not pushed are of its first state and now") {
  record::Trajectory run = pushed();
  record::FrameList frames;
  for (record::Frame frame : run.frames) {
    frame.depth_mm = record::unknown;
    frames.push_back(std::move(frame));
  }
  run.frames = std::move(frames);
  const Plot plot = bins_plot(summarise_run(run), 17, run.frames.back(), {}, 8);
  CHECK(plot.series[0].name == "first state, mean ± s.d. (left)");
  CHECK(plot.series[4].name == "mean of all cells, now");
}

TEST_CASE("the change of the bins has an axis of its own, symmetric about zero") {
  const record::Trajectory run = pushed();
  const Plot plot = change_plot(summarise_run(run), run.frames.back(), 8);
  REQUIRE(plot.series.size() == 1);
  CHECK(plot.series[0].y[0] == Approx(0.01));
  CHECK(plot.series[0].y[1] == Approx(-0.004));
  CHECK(*plot.y.high == Approx(0.011));
  CHECK(*plot.y.low == Approx(-*plot.y.high));
}
