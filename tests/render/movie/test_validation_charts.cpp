// Charts of methods: what is drawn, in which colours, and that all of it fits.
#include "render/movie/validation_charts.h"
#include "tests/render/canvas/ink.h"

using namespace gridshell;
using namespace gridshell::render;
using record::AccuracyRow;
using record::RunOutcome;

namespace {

const std::vector<AccuracyRow> rows{
    {"bend", 1, 100, 4e-2, 1e-3, 0.9e-3, 1.2e-3, RunOutcome::right},
    {"bend", 4, 400, 2.5e-3, 4e-3, 3e-3, 5e-3, RunOutcome::right},
    {"auto 1e-02", 8, 800, 6e-4, 8e-3, 8e-3, 8e-3, RunOutcome::right},
    {"auto 1e-03", 8, 800, 6e-4, 8e-3, 8e-3, 8e-3, RunOutcome::right},
    {"explicit", 1, 100, 4e-2, 2, 2, 2, RunOutcome::right},
    {"explicit", 4, 400, record::unknown, 30, 30, 30, RunOutcome::too_slow},
    {"implicit Euler", 1, 100, record::unknown, 1e-4, 1e-4, 1e-4, RunOutcome::blow_up}};

}  // namespace

TEST_CASE("accuracy chart: curves, spread, front, marks and what is too slow") {
  const Plot plot = accuracy_plot(rows, "A shell");
  REQUIRE(test::series_named(plot, "bend"));
  CHECK(test::series_named(plot, "bend")->x == std::vector<double>{1e-3, 4e-3});
  CHECK(test::series_named(plot, "bend")->x_span[1] == std::array<double, 2>{3e-3, 5e-3});
  CHECK(test::series_named(plot, "Pareto front")->y == std::vector<double>{4e-2, 2.5e-3});
  // tolerances that give the same meshes share a mark
  CHECK(test::series_named(plot, "auto, by tolerance")->x.size() == 1);
  REQUIRE(plot.notes.size() == 1);
  CHECK(plot.notes[0].text == "10^{−2}, 10^{−3}");
  // hollow at the limit, at the error of its mesh
  const Series& last = plot.series.back();
  CHECK(last.hollow);
  CHECK(last.x == std::vector<double>{30});
  CHECK(last.y == std::vector<double>{2.5e-3});
  REQUIRE(plot.references.size() == 1);
  CHECK(plot.references[0].at == 30);
  CHECK(test::series_named(plot, "implicit Euler") == nullptr);
  CHECK(failures_of(rows) == "implicit Euler at 1 (blow_up)");
}

TEST_CASE("accuracy chart: nothing is clipped, the bars of the spread lie within the axes") {
  const Plot plot = accuracy_plot(rows, "A shell");
  const double width = 500, height = 300;
  (void)draw_picture(width, height, 1, white, [&](Canvas& canvas) {
    draw_plot(canvas, Box{0, 0, width, height}.inset(2), plot);
    test::check_apart(canvas);
    CHECK(canvas.texts().size() > 12);
  });
}

TEST_CASE("scaling chart: the legend bears the exponents") {
  std::vector<record::ScalingRow> grown;
  for (int n : {6, 12, 24, 48})
    grown.push_back({"auto 1e-03", n, 4, n * n, 1e-4 * n * n, 0, 0, RunOutcome::right});
  const Plot plot = scaling_plot(grown, "");
  REQUIRE(plot.series.size() == 1);
  CHECK(plot.series[0].name == "auto, 10^{−3}, *n*^{2.0}");
}

namespace {

std::vector<record::StabilityRow> cells() {
  std::vector<record::StabilityRow> rows;
  int k = 0;
  for (const char* method : {"full steps", "default"})
    for (double x : {1e-6, 1.0})
      for (double y : {1.0, 4.0})
        rows.push_back(
            {"load steps", method, "load_steps", x, "edges_per_segment", y, RunOutcome(k++)});
  return rows;
}

}  // namespace

TEST_CASE("outcome map: all texts are there and lie inside") {
  const double width = 400, height = outcome_maps_height(cells(), width);
  (void)draw_picture(width, height, 1, {1, 1, 1, 1}, [&](Canvas& canvas) {
    draw_outcome_maps(canvas, {0, 0, width, height}, cells(), "A shell");
    for (const char* requested :
         {"A shell", "full steps", "default", "load steps", "10−6", "1", "4", "silent wrong",
          "silent: planar saddle", "right", "diverged", "load steps; rows: edges per segment"}) {
      CAPTURE(requested);
      CHECK(test::has(canvas.texts(), requested));
    }
    test::check_apart(canvas);
  });
}

TEST_CASE("outcome map: a cell bears the colour of its outcome") {
  std::vector<record::StabilityRow> one{{"m", "a", "x", 1, "y", 1, RunOutcome::blow_up}};
  const double width = 300, height = outcome_maps_height(one, width);
  const Image image = *draw_picture(width, height, 1, {1, 1, 1, 1}, [&](Canvas& canvas) {
    draw_outcome_maps(canvas, {0, 0, width, height}, one, "");
  });
  const Colour requested = outcome_colour(RunOutcome::blow_up);
  int found = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto* p = image.pixel(x, y);
      found += p[0] == std::lround(255 * requested.r) && p[1] == std::lround(255 * requested.g) &&
               p[2] == std::lround(255 * requested.b);
    }
  // the cell, and its key in the legend
  CHECK(found > 250);
  CHECK(found < 700);
}
