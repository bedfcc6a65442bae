#include "render/movie/sweep_chart.h"

#include "tests/render/canvas/ink.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;
using record::SweepTable;

namespace {

/// Two cases over diameters; the thickest of the second has no state, that of the first is locked.
SweepTable lines() {
  SweepTable table{{"rod.diameter_mm"}, true, false, {}};
  for (const char* one : {"cap", "dome"})
    for (const double diameter : {4.0, 2.0, 0.2}) {
      record::PointResult result;
      result.point = table.rows.size();
      const bool lost = diameter == 4 && std::string(one) == "dome";
      if (lost)
        result.outcome = record::PointOutcome::no_equilibrium;
      else
        result.figures = {{"max_deviation", 0.1 - 0.01 * diameter},
                          {"stiffness_ratio", 6400 / diameter / diameter},
                          {"stable", true},
                          {"limit", diameter == 4 ? "locking" : "none"}};
      table.rows.push_back({{one, {std::to_string(diameter)}, 0}, result});
    }
  return table;
}

}  // namespace

TEST_CASE("a figure over one key: a curve a case, what ended early, what was not found") {
  const Plot plot = sweep_plot(lines(), {.figure = "max_deviation"});
  CHECK(plot.x.label == "rod diameter *D* (mm)");
  REQUIRE(test::series_named(plot, "cap"));
  CHECK(test::series_named(plot, "cap")->x == std::vector<double>{0.2, 2, 4});
  CHECK(test::series_named(plot, "dome")->x == std::vector<double>{0.2, 2});
  REQUIRE(test::series_named(plot, "ended early: locking"));
  REQUIRE(test::series_named(plot, "no state found"));
  CHECK(test::series_named(plot, "no state found")->x == std::vector<double>{4});
  // 0.2 to 4 is a factor of 20 at most: even axes
  CHECK_FALSE(plot.x.logarithmic);
}

TEST_CASE(
    "a result is drawn over another, with a line where it differs by a tenth from its limit") {
  const Plot plot =
      sweep_plot(lines(), {.figure = "max_deviation", .x = "stiffness_ratio", .departure = 0.1});
  CHECK(plot.x.logarithmic);
  CHECK(plot.x.label == "*EA* *d*^{2}/*EI*");
  CHECK(test::series_named(plot, "cap")->x == std::vector<double>{400, 1600, 160000});
  // 10 % below 0.098 lies between 0.08 and 0.098
  REQUIRE(plot.references.size() == 2);
  CHECK(plot.references[0].at > 1600);
  CHECK(plot.references[0].at < 160000);
  CHECK(std::ranges::any_of(
      plot.series, [](const Series& s) { return s.name.starts_with("differs by 10 % at "); }));
}

TEST_CASE("the position of a departure is interpolated, from the right") {
  CHECK(*deviation_onset({1, 2, 3}, {0, 8, 10}, 0.2) == Approx(2));
  CHECK(*deviation_onset({-1, 0, 1}, {0, 8, 10}, 0.6) == Approx(-0.5));
  CHECK(*deviation_onset({1, 10, 100}, {5, 10, 10}, 0.25) == Approx(std::sqrt(10)));
  CHECK_FALSE(deviation_onset({1, 2}, {10, 10.1}, 0.2));
  CHECK_FALSE(deviation_onset({1, 2}, {0, 10}, 0));
  CHECK_FALSE(deviation_onset({}, {}, 0.1));
}

TEST_CASE("names with their units") {
  CHECK(label_of("height_mm") == "height (mm)");
  CHECK(label_of("energy_bend_mJ") == "bending energy (mJ)");
  CHECK(label_of("rod.young_GPa") == "Young's modulus *E* (GPa)");
  CHECK(label_of("joints.stiffness_N_per_mm") == "stiffness (N/mm)");
  CHECK(label_of("largest_stress_MPa") == "largest stress (MPa)");
  CHECK(label_of("joints.mass_g") == "mass (g)");
  CHECK(label_of("loads.snow_N_m2") == "snow (N/m^{2})");
  CHECK(label_of("newton_iterations") == "newton iterations");
}

TEST_CASE("deviations, fractions in the table, are shown in per cent") {
  SweepTable table{{"rod.diameter_mm"}, true, false, {}};
  for (const char* diameter : {"0.1", "0.2"}) {
    record::PointResult result;
    result.figures = {{"max_deviation", 0.03}};
    table.rows.push_back({{"", {diameter}, 0}, result});
  }
  const Plot plot = sweep_plot(table, {.figure = "max_deviation"});
  CHECK(plot.series[0].y == std::vector<double>{3, 3});
  CHECK(plot.y.label.ends_with("(%)"));
}

TEST_CASE("names on an axis are numbered, and drawn at their numbers") {
  SweepTable table{{"actuation.seed"}, false, false, {}};
  for (const char* seed : {"\"up\"", "\"down\""}) {
    record::PointResult result;
    result.figures = {{"height_mm", 10.0}};
    table.rows.push_back({{"", {seed}, 0}, result});
  }
  CHECK(scale_of(table, 0).label == "seed: 1 up, 2 down");
  CHECK(sweep_plot(table, {.figure = "height_mm"}).series[0].x == std::vector<double>{1, 2});
}

TEST_CASE("a map: all that is written fits, cells without a state are named") {
  SweepTable table{{"actuation.radius_mm", "rod.diameter_mm"}, true, false, {}};
  for (const char* one : {"first", "second"})
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 9; ++j) {
        record::PointResult result;
        if (i == 3)
          result.outcome = record::PointOutcome::no_equilibrium;
        else
          result.figures = {{"height_mm", double(i * j)},
                            {"limit", j == 2 ? "snap" : "none"},
                            {"stable", i == 1 ? 0.0 : 1.0}};
        table.rows.push_back(
            {{one, {std::to_string(100 + 2.5 * i), std::to_string(0.1 + 0.05 * j)}, 0}, result});
      }
  const TemporaryFolder folder;
  int drawn = 0;
  const test::CanvasObserver watch([&](const Canvas& canvas) {
    if (canvas.width() < 2) return;
    ++drawn;
    test::check_apart(canvas);
    CHECK(test::has(canvas.texts(), "no state found"));
    CHECK(test::has(canvas.texts(), "ended early"));
    CHECK(test::has(canvas.texts(), "unstable"));
  });
  REQUIRE(write_sweep_map(folder / "height_mm", table, {.figure = "height_mm", .title = "A map"}));
  CHECK(drawn == 3);
}

TEST_CASE("a law is drawn over its first key, of one key or of several") {
  record::PowerLaw law;
  law.keys = {{"", "height_mm", "rod.diameter_mm", -2, 0.01}};
  law.factor = 5;
  law.first_key = {1, 2, 4};
  law.law = {5, 1.25, 0.3125};
  law.found = {5.1, 1.2, 0.32};
  const Plot plot = law_plot({law}, {"height_mm", "", 0, "shells"});
  CHECK_THAT(plot.x.label, Catch::Contains("diameter") && !Catch::Contains("power law"));
  CHECK(plot.series[0].x == law.first_key);
  CHECK(plot.series[1].x == std::vector<double>{1, 4});
  CHECK(plot.series[1].y == std::vector<double>{5, 0.3125});
  law.keys.push_back({"", "height_mm", "net.radius_mm", 1, 0.01});
  const Plot two = law_plot({law}, {"height_mm", "", 0, "shells"});
  CHECK_THAT(two.x.label, Catch::Contains("diameter") && !Catch::Contains("power law"));
  CHECK(two.series[0].x == law.first_key);
}

TEST_CASE("a run that only lacks the figure is no state that was not found") {
  SweepTable table = lines();
  for (auto& row : table.rows) row.result.figures.emplace_back("force_N", std::monostate());
  const Plot plot = sweep_plot(table, {.figure = "force_N"});
  REQUIRE(test::series_named(plot, "no state found"));
  CHECK(test::series_named(plot, "no state found")->x == std::vector<double>{4});
  CHECK_FALSE(test::series_named(plot, "no run has a value"));
  std::erase_if(table.rows, [](const SweepTable::Row& row) {
    return row.result.outcome != record::PointOutcome::done;
  });
  CHECK(test::series_named(sweep_plot(table, {.figure = "force_N"}), "no run has a value"));
  table = {{"rod.diameter_mm", "footprint.rods"}, false, false, {}};
  table.rows.push_back({{"", {"1", "6"}, 0}, {}});
  const TemporaryFolder folder;
  const test::CanvasObserver watch([&](const Canvas& canvas) {
    if (canvas.width() < 2) return;
    CHECK_FALSE(test::has(canvas.texts(), "no state found"));
    CHECK(test::has(canvas.texts(), "no run has force (N)"));
  });
  REQUIRE(write_sweep_map(folder / "force", table, {.figure = "force_N"}));
}
