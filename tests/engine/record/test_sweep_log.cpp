#include "engine/record/sweep_results.h"

#include <cmath>
#include <fstream>

#include "engine/core/file_io.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::record;
using Catch::Contains;

namespace {

const SweepIdentity name{"a preset", 0x1234, 10};

Result<SweepLog> open(const std::filesystem::path& file, const SweepIdentity& of = name) {
  return SweepLog::open(file, of, {"rod.diameter_mm", "actuation.seed"}, [](std::size_t point) {
    return PointKeys{"", {std::to_string(point) + ".5", "\"up\""}, 0};
  });
}

PointResult result(std::size_t point) {
  PointResult made;
  made.point = point;
  made.figures = {{"height_mm", 0.1 * double(point)},
                  {"stable", true},
                  {"limit", "none"},
                  {"force_N", std::monostate{}}};
  return made;
}

std::string text_of(const std::filesystem::path& file) { return read_file(file).value(); }

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// Writes the first three points to the log.
void three_points(const std::filesystem::path& file) {
  auto log = value_of(open(file));
  for (std::size_t point = 0; point < 3; ++point) REQUIRE(log.append(result(point)));
}

}  // namespace

TEST_CASE("a log gives back what was put into it, to the bit") {
  const TemporaryFolder folder;
  const auto file = folder / "sweep.jsonl";
  {
    auto log = value_of(open(file));
    for (const std::size_t point : {3u, 1u}) REQUIRE(log.append(result(point)));
    PointResult none;
    none.point = 2;
    none.outcome = PointOutcome::no_equilibrium;
    none.reason = "no \"rest\"\nthere";
    REQUIRE(log.append(none));
  }
  auto log = value_of(open(file));
  REQUIRE(log.found().size() == 3);
  const auto& three = log.found().at(3);
  CHECK(three.figures == result(3).figures);
  CHECK(log.found().at(2).reason == "no \"rest\"\nthere");
  CHECK(log.found().at(2).outcome == PointOutcome::no_equilibrium);
  CHECK_FALSE(log.cut_off());
  CHECK_THAT(text_of(file), Contains(R"("keys":{"rod.diameter_mm":3.5,"actuation.seed":"up"})"));
}

TEST_CASE("a log that was cut anywhere keeps every whole line, and continues") {
  const TemporaryFolder folder;
  const auto file = folder / "sweep.jsonl";
  three_points(file);
  const std::string whole = text_of(file);
  for (std::size_t length = 0; length <= whole.size();
       length += length + 40 < whole.size() ? 37 : 1) {
    write(file, whole.substr(0, length));
    const auto lines = std::size_t(std::count(whole.begin(), whole.begin() + long(length), '\n'));
    auto log = open(file);
    INFO(length);
    REQUIRE(log);
    CHECK(log->found().size() == (lines > 0 ? lines - 1 : 0));
    for (std::size_t point = 0; point < 3; ++point)
      if (!log->found().contains(point)) REQUIRE(log->append(result(point)));
    CHECK(text_of(file) == whole);
  }
}

TEST_CASE("a line that was changed is not believed") {
  const TemporaryFolder folder;
  const auto file = folder / "sweep.jsonl";
  three_points(file);
  std::string text = text_of(file);
  text[text.find("\"point\":1") + 8] = '7';
  write(file, text);
  auto log = value_of(open(file));
  CHECK(log.damaged() == 1);
  CHECK(log.found().size() == 2);
  CHECK_FALSE(log.found().contains(7));
}

TEST_CASE("a log belongs to one sweep and is written by one process") {
  const TemporaryFolder folder;
  const auto file = folder / "sweep.jsonl";
  {
    auto log = open(file);
    REQUIRE(log);
    CHECK_THAT(refusal(open(file)), Contains("another sweep is writing it"));
  }
  SweepIdentity other = name;
  other.config = 1;
  CHECK_THAT(refusal(open(file, other)), Contains("of another preset"));
  // a file that is no log is left as it is
  for (const char* text : {"my notes", "my notes\n", "{\"sweep\":1}\n"}) {
    write(file, text);
    REQUIRE_FALSE(open(file));
    CHECK(text_of(file) == text);
  }
}

TEST_CASE("a full disk loses the point, not the log") {
  const TemporaryFolder folder;
  const auto file = folder / "sweep.jsonl";
  auto log = open(file);
  REQUIRE(log->append(result(0)));
  {
    const FileSizeLimit limit(text_of(file).size() + 20);
    CHECK_FALSE(log->append(result(1)));
  }
  CHECK(text_of(file).ends_with("}\n"));
  REQUIRE(log->append(result(1)));
  CHECK(read_sweep_log(file)->found.size() == 2);
}

TEST_CASE("a sweep as a table") {
  SweepTable table{{"rod.diameter_mm"}, false, false, {}};
  table.rows.push_back({{"", {"0.5"}, 0}, result(0)});
  PointResult none;
  none.point = 1;
  none.outcome = PointOutcome::refused;
  none.reason = "too thick, by far";
  table.rows.push_back({{"", {"30.0"}, 0}, none});
  CHECK(sweep_csv(table) ==
        "point,rod.diameter_mm,outcome,height_mm,stable,limit,force_N,reason\n"
        "0,0.5,done,0,true,none,,\n"
        "1,30.0,refused,,,,,\"too thick, by far\"\n");
}

TEST_CASE("a cell of a table that is no value of its column is named") {
  const std::string head = "point,footprint.longest_leg,footprint.rods,outcome,reason\n";
  CHECK(read_sweep_csv(head + "0,0.5,12,done,\n").has_value());
  CHECK(gridshell::refusal(read_sweep_csv(head + "0,0.5,12,done,\n1,abc,12,done,\n")) ==
        "line 3: footprint.longest_leg: got 'abc', expected a value of a sweep");
  CHECK(gridshell::refusal(read_sweep_csv(head + "0,0.5,1.5,done,\n")) ==
        "line 2: footprint.rods: got '1.5', expected a value of a sweep");
  CHECK(gridshell::refusal(read_sweep_csv(head + "0,0.5\n")) ==
        "line 2: got 2 cells, expected 5 of a point of a sweep");
  CHECK(gridshell::refusal(read_sweep_csv("point,rod.diameter_mm,reason\n0,0.5,\n")) ==
        "line 1 has no column 'outcome'");
  CHECK(gridshell::refusal(read_sweep_csv(head)) ==
        "got no point of a sweep, expected at least one");
}

TEST_CASE("a power law of a table is found with its exponents, where all is above 0") {
  SweepTable table;
  table.axes = {"a", "b"};
  for (const double a : {1.0, 2.0, 4.0})
    for (const double b : {1.0, 3.0, 9.0}) {
      PointResult result;
      // a tenth too large or too small, in turn
      const double off = table.rows.size() % 2 ? 1.1 : 1 / 1.1;
      result.figures = {{"exact", 5 * a * a / std::sqrt(b)}, {"rough", off * a}, {"low", -a}};
      table.rows.push_back({{"", {std::to_string(a), std::to_string(b)}, 0}, result});
    }
  const auto exact = power_law(table, "", "exact");
  REQUIRE(exact);
  CHECK(exact->factor == Approx(5));
  CHECK(exact->keys[0].exponent == Approx(2));
  CHECK(exact->keys[1].exponent == Approx(-0.5));
  CHECK(exact->keys[1].error < 1e-12);
  const auto rough = value_of(power_law(table, "", "rough"));
  CHECK(std::abs(rough.keys[0].exponent - 1) < 2 * rough.keys[0].error);
  CHECK(rough.scatter == Approx(std::log(1.1)).epsilon(0.1));
  CHECK(exact->is_confirmed());
  CHECK(!power_law(table, "", "low"));
  // no law is fitted over a range so small that anything is nearly a line in it
  for (SweepTable::Row& row : table.rows)
    if (row.keys.values[0] == std::to_string(4.0)) row.keys.values[0] = std::to_string(1.4);
  for (SweepTable::Row& row : table.rows)
    if (row.keys.values[0] == std::to_string(2.0)) row.keys.values[0] = std::to_string(1.2);
  CHECK(!power_law(table, "", "exact"));
  CHECK(!power_law(table, "other", "exact"));
}

TEST_CASE("a plateau that bends at its end has no exponent, nor count shells through themselves") {
  SweepTable table;
  table.axes = {"d"};
  for (int k = 0; k < 21; ++k) {
    const double d = std::pow(10, -2 + 0.12 * k);
    PointResult result;
    // constant over two decades, then a fall by a third, so that a power law is within a tenth of
    // it
    const double fall = d > 1.5 ? 1 - 0.35 * (std::log10(d) - std::log10(1.5)) / 0.22 : 1;
    result.figures = {{"plateau", 0.03 * std::max(fall, 0.6)},
                      {"law", 3 * std::pow(d, -1.0)},
                      {"noisy", 3 * std::pow(d, -1.0) * (k * 7 % 3 == 0 ? 1.04 : 0.98)},
                      {"contacts", 0.0}};
    table.rows.push_back({{"", {std::to_string(d)}, 0}, result});
  }
  const auto plateau = value_of(power_law(table, "", "plateau"));
  CAPTURE(plateau.scatter, plateau.same_side);
  CHECK_FALSE(plateau.is_confirmed());
  CHECK(value_of(power_law(table, "", "law")).is_confirmed());
  CHECK(value_of(power_law(table, "", "noisy")).is_confirmed());
  // points whose shells run through themselves change nothing
  const std::size_t points = plateau.law.size();
  PointResult overlaps;
  overlaps.figures = {{"plateau", 1.0}, {"law", 99.0}, {"noisy", 99.0}, {"contacts", 48.0}};
  table.rows.push_back({{"", {"0.001"}, 0}, overlaps});
  CHECK(value_of(power_law(table, "", "law")).law.size() == points);
}
