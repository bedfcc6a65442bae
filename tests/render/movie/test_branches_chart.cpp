#include "render/movie/state_charts.h"

#include <catch2/catch.hpp>

#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;
using record::BranchEvent;
using record::BranchPoint;

namespace {

/// A path with a gap between two pitchforks near its begin, and a branch from the first.
std::vector<BranchPoint> points() {
  std::vector<BranchPoint> all;
  for (int k = 0; k <= 100; ++k) {
    BranchPoint p;
    p.progress = 0.01 * k;
    p.boundary_radius_mm = 126 - 30 * p.progress;
    p.height_mm = 40 * std::sqrt(p.progress);
    p.amplitude = 0;
    p.negative_pivots = k > 5 && k < 9 ? 1 : 0;
    if (k == 5 || k == 9) p.event = BranchEvent::bifurcation;
    all.push_back(p);
  }
  for (int k = 5; k <= 100; ++k) {
    BranchPoint p = all[std::size_t(k)];
    p.branch = 1;
    p.amplitude = 0.01 * std::sqrt(0.01 * (k - 5));
    p.negative_pivots = k == 5 ? 1 : 0;
    p.event = k == 100 ? BranchEvent::locking : BranchEvent::none;
    all.push_back(p);
  }
  return all;
}

}  // namespace

TEST_CASE("stable parts are full, others dashed, and parts meet where something happens") {
  const Plot plot = branches_plot(points(), BranchAxis::amplitude);
  CHECK(plot.x.label == "*R*_{a} (mm)");
  std::vector<Series> path, branch;
  for (const Series& s : plot.series)
    if (s.line_width > 1.2)
      path.push_back(s);
    else if (s.line_width > 0)
      branch.push_back(s);
  REQUIRE(path.size() == 3);
  CHECK(path[0].dash.empty());
  CHECK_FALSE(path[1].dash.empty());
  CHECK(path[0].x.back() == Approx(126 - 30 * 0.05));
  CHECK(path[1].x.front() == path[0].x.back());
  CHECK(path[1].x.back() == Approx(126 - 30 * 0.09));
  // a branch that is stable from its begin, though the path is not there
  REQUIRE(branch.size() == 1);
  CHECK(branch[0].dash.empty());
}

TEST_CASE("where there is no radius progress is the axis") {
  auto all = points();
  for (BranchPoint& p : all) p.boundary_radius_mm = record::unknown;
  const Plot plot = branches_plot(all, BranchAxis::height);
  CHECK(plot.x.label == "progress");
  CHECK(plot.series.front().x.back() == 1);
}

TEST_CASE("a diagram with a close-up: all that is written fits") {
  const TemporaryFolder folder;
  int drawn = 0;
  const CanvasObserver watch([&](const Canvas& canvas) {
    ++drawn;
    const Box page{0, 0, canvas.width(), canvas.height()};
    for (const Box& text : canvas.text_boxes()) CHECK(page.contains(text));
    for (const char* text : {"stable", "not stable", "bifurcation", "rods at their length"})
      CHECK(std::ranges::find(canvas.texts(), text) != canvas.texts().end());
    // four panels
    CHECK(std::ranges::count(canvas.texts(), "height (mm)") == 2);
  });
  REQUIRE(write_branches(folder.path() / "branches", points(), "A diagram"));
  CHECK(drawn == 3);
}
