#include "engine/study/bifurcation_diagram.h"

#include <map>

#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::study;
using record::BranchEvent;
using record::BranchPoint;

namespace {

Result<BranchDiagram> diagram_of(const std::string& text) {
  Watch watch;
  return branches_study(preset::good(text).base, {.most_branches = 40}, watch);
}

double ratio(const BranchPoint& point) { return point.boundary_radius_mm / 126; }

}  // namespace

TEST_CASE("the shell of Fig. 1 loses its two mirrors near the flat", "[standard]") {
  const auto found = value_of(diagram_of("[accuracy]\nedges_per_segment = 4\n"));
  CHECK(found.symmetry_order == 4);
  CHECK(found.all_followed);
  std::map<int, std::vector<BranchPoint>> branches;
  for (const BranchPoint& point : found.points) branches[point.branch].push_back(point);
  // the path is unstable in one gap alone, between two bifurcations, and keeps its symmetry
  double first = 0, last = 1;
  for (const BranchPoint& point : branches[0]) {
    CHECK(std::abs(point.amplitude) < 1e-6);
    if (point.stable()) continue;
    first = std::max(first, ratio(point));
    last = std::min(last, ratio(point));
  }
  CHECK(first == Approx(0.9953).margin(1.5e-3));
  CHECK(last == Approx(0.9901).margin(1.5e-3));
  // a pair of mirror images leaves there and stays stable to the end, lower in energy
  int to_the_end = 0;
  for (const auto& [number, points] : branches) {
    const BranchPoint& end = points.back();
    if (number == 0 || std::abs(end.progress - 1) > 1e-9 || !end.stable()) continue;
    ++to_the_end;
    CHECK(std::abs(end.amplitude) > 0.01);
  }
  CHECK(to_the_end >= 2);
  CHECK(branches[1].back().energy_mJ == Approx(branches[2].back().energy_mJ).epsilon(1e-6));
  CHECK(branches[1].back().amplitude == Approx(-branches[2].back().amplitude).epsilon(1e-4));
}

TEST_CASE("a closed branch is followed once round, and one that continues says so") {
  const std::string push =
      "[footprint]\nrods = 6\nradius_mm = 66\n[actuation]\nratio = 0.9\n[indentation]\n"
      "joint = [0, 0]\ndepth_mm = 20\n";
  const auto found = value_of(diagram_of(push));
  std::vector<BranchPoint> first;
  for (const BranchPoint& point : found.points)
    if (point.branch == 1) first.push_back(point);
  REQUIRE(first.size() > 100);
  CHECK(first.back().event == BranchEvent::joins);
  // the first point is the bifurcation, the second one that of the first step
  for (std::size_t k = 12; k + 1 < first.size(); ++k)
    CHECK(std::abs(first[k].energy_mJ - first[1].energy_mJ) +
              100 * std::abs(first[k].height_mm - first[1].height_mm) >
          1e-4);
  Watch watch;
  const auto short_ones =
      value_of(branches_study(preset::good(push).base, {.most_steps = 10}, watch));
  CHECK_FALSE(short_ones.all_followed);
  CHECK(std::ranges::count(short_ones.points, BranchEvent::unfinished, &BranchPoint::event) > 0);
}

TEST_CASE("a diagram that there is no path for is refused with the reason") {
  CHECK_THAT(
      refusal(diagram_of(
          "[footprint]\nkind = \"net\"\n[actuation]\nstart = \"net\"\n[accuracy]\nmodel = \"net\"\n"
          "tolerance = 0.1\n")),
      Catch::Contains("not the net itself"));
}
