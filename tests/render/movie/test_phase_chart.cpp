#include "render/movie/state_charts.h"

#include <catch2/catch.hpp>

#include "engine/record/phase_diagram.h"

using namespace gridshell;
using namespace gridshell::render;
using record::StateClass;

namespace {

record::PhasePoint point(double leg, int rods, StateClass kind, const record::StateCount& count) {
  record::PhasePoint made;
  made.longest_leg = leg;
  made.rods = rods;
  made.found = true;
  made.classes[std::size_t(kind)] = count;
  return made;
}

const Series* named(const Plot& plot, const std::string& name) {
  for (const Series& series : plot.series)
    if (series.name == name) return &series;
  return nullptr;
}

}  // namespace

TEST_CASE("a class that trials met is filled, one of symmetric forms alone is hollow") {
  record::PhaseDiagram diagram{point(1, 10, StateClass::ii, {1, 5, 0}),
                               point(2, 10, StateClass::ii, {1, 0, 3}),
                               point(2, 12, StateClass::other, {7, 9, 0})};
  record::PhasePoint nothing;
  nothing.longest_leg = 1;
  nothing.rods = 12;
  diagram.push_back(nothing);
  const Plot plot = phase_plot(diagram, "A diagram");
  const Series* ii = named(plot, "state *ii*");
  REQUIRE(ii);
  CHECK_FALSE(ii->hollow);
  REQUIRE(ii->x.size() == 1);
  CHECK(std::abs(ii->x[0] - 1) < 0.5);
  const bool hollow = std::ranges::any_of(plot.series, [](const Series& series) {
    return series.hollow && series.x.size() == 1 && std::abs(series.x[0] - 2) < 0.5;
  });
  CHECK(hollow);
  REQUIRE(plot.notes.size() == 1);
  CHECK(plot.notes[0].text == "+7");
  REQUIRE(named(plot, "none found"));
  CHECK(named(plot, "none found")->x == std::vector<double>{1});
}

TEST_CASE("the lines of the diagram are those of the shortest leg") {
  const record::PhaseDiagram diagram{point(0.25, 4, StateClass::i, {1, 1, 0}),
                                     point(5, 20, StateClass::i, {1, 1, 0})};
  const Plot plot = phase_plot(diagram, "");
  int lines = 0;
  for (const Series& series : plot.series) {
    if (series.line_width == 0) continue;
    const double leg = lines == 0 ? 1 : lines == 1 ? 0 : -1;
    int drawn = 0;
    for (std::size_t k = 0; k < series.x.size(); ++k) {
      if (!std::isfinite(series.x[k])) continue;
      ++drawn;
      const double n = series.y[k];
      const double radius = series.x[k] + 0.5 * (n - 1);
      CHECK(std::sqrt(radius * radius - 0.25 * (n - 1) * (n - 1)) - 0.5 * (n - 1) ==
            Approx(leg).margin(1e-9));
    }
    CHECK(drawn > 20);
    ++lines;
  }
  CHECK(lines == 3);
}
