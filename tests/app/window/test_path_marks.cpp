// What a way is marked by: stretches that are not stable, and events.
#include <catch2/catch.hpp>

#include "app/window/shell_view.h"
#include "engine/solve/equilibrium_path.h"

using namespace gridshell;
using namespace gridshell::window;

namespace {

/// A way of load steps at these parameters, each with so many negative pivots.
PathRecord way_of(const std::vector<std::pair<double, int>>& steps) {
  PathRecord way;
  for (const auto& [t, pivots] : steps) {
    LoadStep step;
    step.point.t = t;
    step.certificate.negative_pivots = pivots;
    way.load_steps.push_back(std::move(step));
  }
  return way;
}

}  // namespace

TEST_CASE(
    "a stretch that is not stable reaches as far as states are known not to be, or to its event") {
  const PathRecord way = way_of({{0.2, 0}, {0.4, 1}, {0.6, 2}, {0.8, 0}});
  const auto marks = marks_of(way, {}, -1, progress_at);
  REQUIRE(marks.size() == 1);
  CHECK(marks[0].unstable);
  CHECK(marks[0].from == Approx(0.4 * 0.4));
  CHECK(marks[0].to == Approx(0.6 * 0.6));
  Event lost;
  lost.t = 0.35;
  const auto told = marks_of(way, {lost}, -1, progress_at);
  REQUIRE(told.size() == 2);
  CHECK(told[0].from == Approx(0.35 * 0.35));
  CHECK((!told[1].unstable && told[1].from == told[1].to && told[1].what == "stability lost"));
}

TEST_CASE("stretches of several ways that meet are one, those apart or of other joints are not") {
  std::vector<PathMark> marks{{0.1, 0.2, -1, true, "not stable"}};
  add_marks(marks, {{0.2, 0.4, -1, true, "not stable"},
                    {0.6, 0.7, -1, true, "not stable"},
                    {0.3, 0.5, 7, true, "not stable"}});
  REQUIRE(marks.size() == 3);
  CHECK((marks[0].from == 0.1 && marks[0].to == 0.4));
  CHECK(text_of_place(marks[0], [](double at) { return 100 * at; }) == "40 to 10");
  // a way back is no other stretch
  add_marks(marks, marks_of(way_of({{0.7, 1}, {0.65, 1}}), {}, -1, [](double t) { return t; }));
  CHECK(marks.size() == 3);
}
