// Tables of charts, fronts and exponents.
#include "engine/record/study_tables.h"

#include <catch2/catch.hpp>

#include "engine/formats/csv.h"

using namespace gridshell::record;

TEST_CASE("charts: columns, and empty where nothing is known") {
  CHECK(
      csv_table<AccuracyRow>({{"bend", 4, 2736, 2.5e-3, 0.5, 0.25, 1, RunOutcome::right},
                              {"explicit", 8, 5904, unknown, 30, 30, 30, RunOutcome::too_slow}}) ==
      "method,edges_per_segment,dof,error,cpu_s,cpu_min_s,cpu_max_s,outcome\n"
      "bend,4,2736,0.0025,0.5,0.25,1,right\n"
      "explicit,8,5904,,30,30,30,too_slow\n");
  CHECK(csv_table<StabilityRow>({{"newton", "full steps", "load_steps", 5, "edges_per_segment", 2,
                                  RunOutcome::planar_saddle}}) ==
        "map,method,x_name,x,y_name,y,outcome\n"
        "newton,full steps,load_steps,5,edges_per_segment,2,planar_saddle\n");
  CHECK(csv_table<ScalingRow>({}) ==
        "method,rods,edges_per_segment,dof,cpu_s,cpu_min_s,cpu_max_s,outcome\n");
}

TEST_CASE("charts: the Pareto front is what nothing beats in both") {
  const auto row = [](double error, double seconds, RunOutcome outcome = RunOutcome::right) {
    return AccuracyRow{"m", 1, 1, error, seconds, seconds, seconds, outcome};
  };
  const std::vector<AccuracyRow> rows{row(1e-2, 1),
                                      row(1e-3, 3),
                                      row(2e-3, 4),
                                      row(0.99e-2, 2),
                                      row(1e-9, 0.1, RunOutcome::other_state),
                                      row(1e-4, 9)};
  CHECK(pareto_front(rows) == std::vector<std::size_t>{0, 1, 5});
}

TEST_CASE("charts: the exponent of a power law, and none of fewer than four points") {
  CHECK(exponent({2, 4, 8, 16}, {3 * 8, 3 * 64, 3 * 512, 3 * 4096}) == Approx(3));
  CHECK(std::isnan(exponent({2, 4, 8}, {3 * 8, 3 * 64, 3 * 512})));
  CHECK(std::isnan(exponent({2}, {1})));
  CHECK(std::isnan(exponent({2, 3}, {1, 0})));
}
