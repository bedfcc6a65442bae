#include "render/movie/colour_range.h"

#include <catch2/catch.hpp>

#include "tests/render/synthetic.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

// a run of two frames whose cells all have these K
record::Trajectory of_K(double first, double last) {
  record::Trajectory run = synthetic::dome(2, 1);
  run.frames[0].cell_K.setConstant(first);
  run.frames[1].cell_K.setConstant(last);
  return run;
}

std::optional<ColourBar> bar(const std::vector<record::Trajectory>& runs,
                             const MovieStyle& style = {}) {
  std::vector<Survey> surveys;
  for (const auto& run : runs) surveys.push_back(survey_of(run));
  std::vector<const Survey*> all;
  for (const Survey& survey : surveys) all.push_back(&survey);
  return colour_bar_of(all, style);
}

}  // namespace

TEST_CASE("K of one sign takes a sequential map, of two signs one about zero") {
  const auto positive = bar({of_K(0, 0.3)});
  REQUIRE(positive);
  CHECK(positive->scale.map == ColourMap::sequential);
  CHECK(positive->scale.low == 0);
  CHECK(positive->scale.high >= 0.3);
  const auto negative = bar({of_K(0, -0.3)});
  CHECK(negative->scale.map == ColourMap::sequential);
  CHECK(negative->scale.high == 0);
  CHECK(negative->scale(0).b == positive->scale(0).b);
  CHECK(negative->scale(negative->scale.low).b == positive->scale(positive->scale.high).b);
  const auto both = bar({of_K(-0.2, 0.3)});
  CHECK(both->scale.map == ColourMap::diverging);
  CHECK(both->scale.low == -both->scale.high);
}

TEST_CASE("runs shown together share one range, so that what is not curved does not look so") {
  const auto alone = bar({of_K(0.001, -0.001)});
  const auto shared = bar({of_K(0, 0.4), of_K(0.001, -0.001), of_K(0, -0.4)});
  CHECK(shared->scale.high >= 0.4);
  CHECK(shared->scale.map == ColourMap::diverging);
  // nor alone: a scale never shrinks to noise
  CHECK(alone->scale.high >= 0.02);
}

TEST_CASE("the change of K starts at nothing, and the style's range goes before") {
  MovieStyle style;
  style.colour_by = ColourBy::K_change;
  const auto change = bar({of_K(0.5, 0.45)}, style);
  CHECK(change->scale.low <= -0.05);
  CHECK(change->scale.high <= 0.1);
  CHECK(change->label.starts_with("Δ"));
  style.look.range = {{-0.01, 0.03}};
  const auto given = bar({of_K(0.5, 0.45)}, style);
  CHECK(given->scale.low == -0.01);
  CHECK(given->scale.high == 0.03);
  CHECK(given->beyond_low);
  CHECK_FALSE(given->beyond_high);
  style.look.cells = false;
  CHECK_FALSE(bar({of_K(0.5, 0.45)}, style));
}
