// Charts of methods: what is drawn, and that all of it fits.
#include "render/movie/validation_charts.h"

#include <catch2/catch.hpp>

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

const Series* find(const Plot& plot, const std::string& name) {
  for (const Series& series : plot.series)
    if (series.name == name) return &series;
  return nullptr;
}

}  // namespace

TEST_CASE("accuracy chart: curves, spread, front, marks and what is too slow") {
  const Plot plot = accuracy_plot(rows, "A shell");
  REQUIRE(find(plot, "bend"));
  CHECK(find(plot, "bend")->x == std::vector<double>{1e-3, 4e-3});
  CHECK(find(plot, "bend")->x_span[1] == std::array<double, 2>{3e-3, 5e-3});
  CHECK(find(plot, "Pareto front")->y == std::vector<double>{4e-2, 2.5e-3});
  // tolerances that come to the same meshes share a mark
  CHECK(find(plot, "auto, by tolerance")->x.size() == 1);
  REQUIRE(plot.notes.size() == 1);
  CHECK(plot.notes[0].text == "10^{−2}, 10^{−3}");
  // hollow at the limit, at the error of its mesh
  const Series& last = plot.series.back();
  CHECK(last.hollow);
  CHECK(last.x == std::vector<double>{30});
  CHECK(last.y == std::vector<double>{2.5e-3});
  REQUIRE(plot.references.size() == 1);
  CHECK(plot.references[0].at == 30);
  CHECK(find(plot, "implicit Euler") == nullptr);
  CHECK(failures_of(rows) == "implicit Euler at 1 (blow_up)");
}

TEST_CASE("accuracy chart: nothing is clipped, the bars of the spread lie within the axes") {
  const Plot plot = accuracy_plot(rows, "A shell");
  const double width = 500, height = 300;
  draw_picture(width, height, 1, {1, 1, 1, 1}, [&](Canvas& canvas) {
    draw_plot(canvas, Box{0, 0, width, height}.inset(2), plot);
    for (const Box& text : canvas.text_boxes()) CHECK(Box{0, 0, width, height}.contains(text));
    CHECK(canvas.texts().size() > 12);
  });
}

TEST_CASE("scaling chart: the legend bears the exponents") {
  std::vector<record::ScalingRow> grown;
  for (int n : {6, 12, 24})
    grown.push_back({"auto 1e-03", n, 4, n * n, 1e-4 * n * n, 0, 0, RunOutcome::right});
  const Plot plot = scaling_plot(grown, "");
  REQUIRE(plot.series.size() == 1);
  CHECK(plot.series[0].name == "auto, 10^{−3}, *n*^{2.0}");
}
