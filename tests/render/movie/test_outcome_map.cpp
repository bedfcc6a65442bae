// Maps of outcomes: every cell drawn in its colour, a legend, nothing clipped.
#include "render/movie/validation_charts.h"

#include <catch2/catch.hpp>
#include <set>

using namespace gridshell;
using namespace gridshell::render;
using record::RunOutcome;

namespace {

std::vector<record::StabilityRow> rows() {
  std::vector<record::StabilityRow> rows;
  const RunOutcome all[] = {RunOutcome::right,         RunOutcome::refused,
                            RunOutcome::not_converged, RunOutcome::blow_up,
                            RunOutcome::too_slow,      RunOutcome::planar_saddle,
                            RunOutcome::other_state,   RunOutcome::silent_wrong};
  int k = 0;
  for (const char* method : {"full steps", "default"})
    for (double x : {1e-6, 1.0})
      for (double y : {1.0, 4.0})
        rows.push_back({"load steps", method, "load_steps", x, "edges_per_segment", y, all[k++]});
  return rows;
}

}  // namespace

TEST_CASE("outcome map: all texts are there and lie inside") {
  const double width = 400, height = outcome_maps_height(rows(), width);
  draw_picture(width, height, 1, {1, 1, 1, 1}, [&](Canvas& canvas) {
    draw_outcome_maps(canvas, {0, 0, width, height}, rows(), "A shell");
    const std::set<std::string> texts(canvas.texts().begin(), canvas.texts().end());
    for (const char* wanted : {"A shell", "full steps", "default", "load steps", "10−6", "1", "4",
                               "silent wrong", "silent: planar saddle", "right"}) {
      CAPTURE(wanted);
      CHECK(texts.contains(wanted));
    }
    for (const Box& text : canvas.text_boxes()) CHECK(Box{0, 0, width, height}.contains(text));
    for (std::size_t a = 0; a < canvas.text_boxes().size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        CHECK_FALSE(canvas.text_boxes()[a].overlaps(canvas.text_boxes()[b]));
  });
}

TEST_CASE("outcome map: a cell bears the colour of its outcome") {
  std::vector<record::StabilityRow> one{{"m", "a", "x", 1, "y", 1, RunOutcome::blow_up}};
  const double width = 300, height = outcome_maps_height(one, width);
  const Image image = draw_picture(width, height, 1, {1, 1, 1, 1}, [&](Canvas& canvas) {
    draw_outcome_maps(canvas, {0, 0, width, height}, one, "");
  });
  const Colour wanted = outcome_colour(RunOutcome::blow_up);
  int found = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto* p = image.pixel(x, y);
      found += p[0] == std::lround(255 * wanted.r) && p[1] == std::lround(255 * wanted.g) &&
               p[2] == std::lround(255 * wanted.b);
    }
  // the cell, and its key in the legend
  CHECK(found > 250);
  CHECK(found < 700);
}
