#include "engine/record/phase_diagram.h"

#include <catch2/catch.hpp>

#include "engine/formats/csv.h"

using namespace gridshell::record;

namespace {

StateRow state(StateClass kind, int count, int confined, const char* inflections) {
  StateRow row;
  row.kind = kind;
  row.count = count;
  row.count_confined = confined;
  row.inflections = inflections;
  return row;
}

SweepTable::Row found(const char* rods, const char* leg, const std::vector<StateRow>& states) {
  StateSearch search;
  for (const StateRow& row : states) search.at_rest += row.count;
  return {{"", {rods, leg}, 0}, {0, PointOutcome::done, "", search_figures(search, states)}};
}

const StateRow dome = state(StateClass::i, 19, 7, "0 0 | 0 0"),
               tilted = state(StateClass::other, 1, 0, "0 0 | 0 0"),
               pair = state(StateClass::ii, 12, 0, "0 1 | 1 0"),
               wheel = state(StateClass::iii, 0, 3, "2 1 | 1 2"),
               other = state(StateClass::other, 8, 0, "10 1 | 1 0");

}  // namespace

TEST_CASE("legs are those of the paper, and each says the other") {
  // the shell of Fig. 1: R_o = 126 mm, d = 20 mm, n = 12
  CHECK(longest_leg(126.0 / 20, 12) == Approx(0.8));
  CHECK(shortest_leg(126.0 / 20, 12) == Approx(std::sqrt(6.3 * 6.3 - 5.5 * 5.5) - 5.5));
  CHECK(shortest_leg(126.0 / 20, 12) < 0);
  for (const double leg : {1.0, 0.0, -1.0})
    CHECK(shortest_leg(longest_leg_at(leg, 14) + 6.5, 14) == Approx(leg).margin(1e-12));
}

TEST_CASE("figures of a search count states and how often they were met, by class and by order") {
  CHECK(dome.first_order());
  CHECK_FALSE(wheel.first_order());
  CHECK_FALSE(other.first_order());
  const auto row = found("12", "0.8", {dome, tilted, pair, wheel, other}).result;
  CHECK(state_count(row, "i") == StateCount{1, 19, 7});
  CHECK(state_count(row, "iii") == StateCount{1, 0, 3});
  CHECK(state_count(row, "iv") == StateCount{0, 0, 0});
  CHECK(state_count(row, "other") == StateCount{2, 9, 0});
  CHECK(state_count(row, "first_order") == StateCount{2, 20, 7});
  CHECK_FALSE(state_count(PointResult{}, "i"));
}

TEST_CASE("a diagram shows by the shortest leg where domes are alone and where more is found") {
  SweepTable table{{"footprint.rods", "footprint.longest_leg"}, false, false, {}};
  CHECK(makes_phase_diagram(table.axes));
  CHECK_FALSE(makes_phase_diagram({"footprint.rods", "rod.diameter_mm"}));
  CHECK_FALSE(makes_phase_diagram({"footprint.rods"}));
  table.rows = {found("4", "5", {dome}), found("4", "4", {dome, tilted}),
                found("12", "0.8", {pair, wheel, other, other}), found("20", "0.25", {pair, pair})};
  table.rows.push_back({{"", {"12", "1"}, 0}, {4, PointOutcome::no_equilibrium, "none", {}}});
  const PhaseDiagram diagram = phase_diagram_of(table, "");
  REQUIRE(diagram.size() == 5);
  CHECK(diagram[2].rods == 12);
  CHECK(diagram[2].longest_leg == 0.8);
  CHECK(diagram[2].not_in_paper() == 2);
  CHECK(diagram[3].not_in_paper() == 1);
  CHECK_FALSE(diagram[4].found);
  const auto regions = regions_of(diagram);
  REQUIRE(regions.size() == 4);
  CHECK(name_of(regions[0]) == "l_d > 1");
  CHECK(name_of(regions[1]) == "0 < l_d <= 1");
  CHECK(name_of(regions[3]) == "l_d <= -1");
  CHECK(regions[0].points == 2);
  CHECK(regions[0].first_order_alone == 2);
  CHECK(regions[0].symmetry_broken == 1);
  CHECK(regions[0].several_states == 1);
  CHECK(regions[0].met_first_order == 39);
  CHECK(regions[1].points == 0);
  // (0.8, 12) has l_d = -2.4; a point without a result is in no region
  CHECK(regions[2].points + regions[3].points == 2);
  CHECK(regions[3].with[std::size_t(StateClass::iii)] == 1);
  CHECK(regions[3].states_more == 3);
  CHECK_FALSE(csv_table(regions).empty());
}
