#include "engine/core/file_io.h"
#include "tests/presets.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::preset;

TEST_CASE("an empty preset is the default one, with the name of its file") {
  const auto presets = good("");
  CHECK(presets.base.name == "good");
  CHECK(presets.base.footprint.rods == 12);
  CHECK(presets.base.footprint.radius_mm == 126.0);
  CHECK(presets.cases.empty());
}

TEST_CASE("every kind of value reaches its field") {
  const auto preset = good(R"(
title = "a title"
allow_unstable = true
[rod]
diameter_mm = 1           # an integer is a number
[footprint]
rods = 8
placement = "on_axis"
[actuation]
seed_diagonal = "y=-x"
[movie]
size = [640, 360]
colour_by = "none"
[figure]
radii_mm = [126, 110.5]
)")
                          .base;
  CHECK(preset.title == "a title");
  CHECK(preset.allow_unstable);
  CHECK(preset.rod.diameter_mm == 1.0);
  CHECK(preset.footprint.rods == 8);
  CHECK(preset.footprint.placement == Placement::on_axis);
  CHECK(preset.actuation.seed_diagonal == SeedDiagonal::y_eq_minus_x);
  CHECK(preset.movie.size == std::array<int, 2>{640, 360});
  CHECK(preset.movie.colour_by == ColourBy::none);
  CHECK(preset.figure.radii_mm == std::vector<double>{126.0, 110.5});
}

// more of them, through the whole program: tests/app/test_bad_input.cpp
TEST_CASE("an error names its position, key, value, what is wrong and what is right") {
  using Row = std::pair<std::string, std::string>;
  const auto [text, sentence] = GENERATE(values<Row>({
      {"title = 12", "bad.toml:1:9: title: got 12 (an integer), expected a string"},
      {"[movie]\nelephant = true",
       "bad.toml:2:1: [movie] elephant: unknown key, expected one of frames, size, fps, quality, "
       "colour_by, azimuth_deg, elevation_deg, turn_deg, zoom, inset, bins, captions, beside, "
       "view, target_mm, orthographic, bins_range, views, seconds, hold_first_s, hold_s, title_s, "
       "pace, webm, gif, poster"},
      {"radius_mm = 3.0",
       "bad.toml:1:1: radius_mm: unknown key; did you mean 'footprint.radius_mm'?"},
      {"[actuatoin]\nradius_mm = 3",
       "bad.toml:1:2: [actuatoin]: unknown table; did you mean 'actuation'?"},
      {"footprint = 3",
       "bad.toml:1:1: footprint: got 3, expected a table of keys: kind, file, file_unit, join_mm, "
       "linkage, "
       "rods, radius_mm, longest_leg, spacing_mm, placement, boundary, half_x_mm, half_y_mm, "
       "exponent, points_mm"},
      {"[footprint]\nradius_mm = nan",
       "bad.toml:2:13: [footprint] radius_mm: got nan (not finite), expected a number > 0"},
      {"[footprint]\nradius_mm = inf",
       "bad.toml:2:13: [footprint] radius_mm: got inf (not finite), expected a number > 0"},
      {"[footprint]\nradius_mm = \"big\"",
       "bad.toml:2:13: [footprint] radius_mm: got \"big\" (a string), expected a number > 0"},
      {"[footprint]\nrods = 12.0",
       "bad.toml:2:8: [footprint] rods: got 12.0 (a number), expected an integer from 1 to 500"},
      {"[footprint]\nrods = 99999999999",
       "bad.toml:2:8: [footprint] rods: got 99999999999 (out of range), expected an integer from 1 "
       "to 500"},
      {"[footprint]\nplacement = \"haf\"",
       "bad.toml:2:13: [footprint] placement: got \"haf\" (unknown name), expected \"half\" or "
       "\"on_axis\"; did you mean 'half'?"},
      {"[accuracy]\ntolerance = 0",
       "bad.toml:2:13: [accuracy] tolerance: got 0 (out of range), expected a number from 1e-09 to "
       "1"},
      {"[movie]\nsize = [1280]",
       "bad.toml:2:8: [movie] size: got [ 1280 ] (a list of 1), expected two integers, each from "
       "16 to 16384"},
      {"[movie]\ninset = 1",
       "bad.toml:2:9: [movie] inset: got 1 (an integer), expected true or false"},
      {"[figure]\nradii_mm = [100.0, \"x\"]",
       "bad.toml:2:12: [figure] radii_mm: got [ 100.0, \"x\" ] (a list with a string), expected a "
       "list of numbers, each > 0"},
      {"[rod]\ndiameter_mm = 20.0",
       "bad.toml:2:15: [rod] diameter_mm: got 20.0 (neighbouring rods would touch), expected less "
       "than [footprint] spacing_mm = 20"},
      {"[figure]\nradii_mm = [126.0, 80.0]",
       "bad.toml:2:12: [figure] radii_mm: got [126.0, 80.0] (80 is not on the path), expected "
       "values that fall from at most R_o = 126 to at least R_a = 94.5"},
  }));
  CHECK(errors_of(text) == sentence);
}

TEST_CASE("text that is not TOML is refused where it stops being it") {
  CHECK_THAT(errors_of("title = \"x\"\nrods == 3"),
             Catch::StartsWith("bad.toml:2:") && Catch::Contains(": not TOML: "));
  // a key given twice would silently win or lose
  CHECK_THAT(errors_of("[rod]\nyoung_GPa = 1.0\nyoung_GPa = 2.0"),
             Catch::StartsWith("bad.toml:3:") && Catch::Contains("redefine"));
}

TEST_CASE("all errors of a file are reported at once, in its order") {
  CHECK(errors_of("[movie]\nfps = 0\n[footprint]\nradius_mm = -1\nrod = 3\n") ==
        "bad.toml:2:7: [movie] fps: got 0 (out of range), expected an integer from 1 to "
        "240\nbad.toml:4:13: [footprint] radius_mm: got -1 (out of range), expected a number > "
        "0\nbad.toml:5:1: [footprint] rod: unknown key; did you mean 'rods'?");
}

TEST_CASE("a refused value conflicts with nothing") {
  // the default of 126 mm, left behind by the refused -1, is not what the user wrote
  CHECK(errors_of("[footprint]\nradius_mm = -1\n[actuation]\nradius_mm = 200.0") ==
        "bad.toml:2:13: [footprint] radius_mm: got -1 (out of range), expected a number > 0");
}

TEST_CASE("an override (--set) lies over the file") {
  const std::string text = "[footprint]\nradius_mm = 130.0\n";
  const auto set = [](const std::string& argument) { return parse_override(argument).value(); };
  CHECK(good(text, {set("footprint.radius_mm=140.5")}).base.footprint.radius_mm == 140.5);
  CHECK(good(text, {set("movie.size=[320, 200]")}).base.movie.size == std::array<int, 2>{320, 200});
  CHECK(good(text, {set("title=\"quoted\"")}).base.title == "quoted");
  SECTION("what is not TOML is a string") {
    CHECK(good(text, {set("actuation.seed=down")}).base.actuation.seed == Seed::down);
    CHECK(good(text, {set("title=two words")}).base.title == "two words");
    CHECK(good(text, {set("title=a\nrods = 3")}).base.title == "a\nrods = 3");
  }
  SECTION("the last one counts") {
    CHECK(good(text, {set("rod.young_GPa=1"), set("rod.young_GPa=2")}).base.rod.young_GPa == 2);
  }
  SECTION("errors name the option") {
    CHECK(errors_of(text, {set("rod.diameter_mm=thick")}) ==
          "--set: [rod] diameter_mm: got \"thick\" (a string), expected a number > 0");
    CHECK(errors_of(text, {set("seed=up")}) ==
          "--set: seed: unknown key; did you mean 'actuation.seed'?");
    CHECK(errors_of(text, {set("foot.rods=3")}) ==
          "--set: [foot] rods: unknown table; did you mean 'footprint'?");
    CHECK(errors_of(text, {set("footprint.radius_mm=90")}) ==
          "--set: [actuation] radius_mm: got 94.5 (larger than the footprint), expected at most "
          "[footprint] radius_mm = 90");
  }
  SECTION("without a key or a value there is nothing to set") {
    CHECK(parse_override("footprint.radius_mm").error().message ==
          "--set footprint.radius_mm: expected table.key=value, for example --set "
          "footprint.radius_mm=126");
    CHECK_FALSE(parse_override("=3"));
  }
}

TEST_CASE("cases are the base with some keys changed") {
  const auto presets = good(R"(
title = "two"
[actuation]
radius_mm = 100.0
[[case]]
name = "far"
actuation.radius_mm = 90.0
[[case]]
name = "thin-0.1"
rod.diameter_mm = 0.1
title = "the thin one"
)",
                            {parse_override("movie.frames=7").value()});
  REQUIRE(presets.cases.size() == 2);
  const auto &far = presets.cases[0], &thin = presets.cases[1];
  CHECK(far.name == "far");
  CHECK(far.preset.name == "good/far");
  CHECK(far.preset.actuation.radius_mm == 90.0);
  CHECK(far.preset.title == "two");
  CHECK(thin.preset.actuation.radius_mm == 100.0);
  CHECK(thin.preset.rod.diameter_mm == 0.1);
  CHECK(thin.preset.title == "the thin one");
  // overrides of the command line apply to every case
  CHECK(far.preset.movie.frames == 7);
  CHECK(thin.preset.movie.frames == 7);
}

TEST_CASE("cases need names that can be folders, each its own") {
  using Row = std::pair<std::string, std::string>;
  const auto [text, sentence] = GENERATE(values<Row>({
      {"[[case]]\nrod.young_GPa = 1.0",
       "bad.toml:1:1: [[case]] name: got none, expected a name: name = \"...\""},
      {"[[case]]\nname = \"../up\"",
       "bad.toml:2:8: [[case]] name: got \"../up\" (the name of a folder), expected letters, "
       "digits, '.', '_' or '-' after a letter or digit"},
      {"[[case]]\nname = \"manifest.txt\"",
       "bad.toml:2:8: [[case]] name: got \"manifest.txt\" (a name of a file of a run), expected "
       "another ending than .txt"},
      {"[[case]]\nname = \"a\"\n[[case]]\nname = \"a\"",
       "bad.toml:4:8: [[case]] name: got \"a\" (used twice), expected a unique name"},
      {"[case]\nname = \"a\"",
       "bad.toml:1:1: case: got one table or value, expected tables, each [[case]]"},
      {"[[case]]\nname = \"a\"\nactuation.radius_mm = 200.0",
       "bad.toml:3:23: [actuation] radius_mm: got 200.0 (larger than the footprint), expected at "
       "most [footprint] radius_mm = 126"},
  }));
  CHECK(errors_of(text) == sentence);
}

TEST_CASE("lists of tables: blocks and joins, and what is wrong with them") {
  const auto preset = good(R"(
[footprint]
kind = "blocks"
[[block]]
name = "left"
radius_mm = 100.0
east = 2
[[block]]
name = "right"
kind = "cylinder"
west = -1
[[join]]
first = "left.east"
second = "right.west"
)")
                          .base;
  REQUIRE(preset.block.size() == 2);
  CHECK(preset.block[0].net.radius_mm == 100.0);
  CHECK(preset.block[0].east == 2);
  CHECK_FALSE(preset.block[0].west.has_value());
  CHECK(preset.block[1].net.kind == NetKind::cylinder);
  CHECK(preset.block[1].net.radius_mm == Net{}.radius_mm);
  REQUIRE(preset.join.size() == 1);
  CHECK(preset.join[0].second == "right.west");

  const std::string start = "[footprint]\nkind = \"blocks\"\n[[block]]\nname = \"a\"\n";
  using Row = std::pair<std::string, std::string>;
  const auto [text, sentence] = GENERATE_COPY(values<Row>({
      {"[footprint]\nkind = \"blocks\"",
       "bad.toml:2:8: [footprint] kind: got \"blocks\" (no block), expected at least one "
       "[[block]]"},
      {start + "[[block]]\nname = \"a\"",
       "bad.toml:6:8: [[block]] 2 name: got \"a\" (used twice), expected a unique name"},
      {start + "[[block]]\nradius_mm = 1.0",
       "bad.toml:5:1: [[block]] 2 name: got \"\", expected a name without a dot"},
      {start + "east = 0.5",
       "bad.toml:5:8: [[block]] 1 east: got 0.5 (a number), expected an integer from -500 to 500, "
       "or \"none\""},
      {start + "kind = \"cone\"",
       "bad.toml:5:8: [[block]] 1 kind: got \"cone\" (unknown name), expected \"sphere\", "
       "\"cylinder\", \"spool\", \"beltrami\", \"profile\", \"translation\" or \"surface\""},
      {start + "[[join]]\nfirst = \"a.est\"\nsecond = \"a.west\"",
       "bad.toml:6:9: [[join]] 1 first: got \"a.est\" (not a side of a block), expected a block's "
       "name and east, west, north or south with a dot between; did you mean 'a.east'?"},
      {start + "kind = \"profile\"\nprofile = [[1, 2], [3, 4]]",
       "bad.toml:6:11: [[block]] 1 profile: got [[1.0, 2.0], [3.0, 4.0]] (2 points), expected at "
       "least 4 for kind = \"profile\""},
      {"[block]\nname = \"a\"", "bad.toml:1:2: block: expected tables, each [[block]]"},
      {start + "[[case]]\nname = \"a\"\n[case.block]\nname = \"b\"",
       "bad.toml:7:7: block: expected tables, each [[case.block]]"},
      {start + "[[case]]\nname = \"a\"\n[[case.block]]\nname = \"b\"\neast = 0.5",
       "bad.toml:9:8: [[block]] 1 east: got 0.5 (a number), expected an integer from -500 to 500, "
       "or \"none\""},
  }));
  CHECK(errors_of(text) == sentence);
}

TEST_CASE("a case's list of tables replaces the file's") {
  const auto presets = value_of(read_preset_text(
      "[footprint]\nkind = \"blocks\"\n[[block]]\nname = \"a\"\nradius_mm = 90.0\n[[block]]\n"
      "name = \"b\"\n[[join]]\nfirst = \"a.east\"\nsecond = \"b.west\"\n[[case]]\nname = \"both\"\n"
      "[[case]]\nname = \"one\"\n[[case.block]]\nname = \"c\"\n[[case.join]]\n"
      "first = \"c.east\"\nsecond = \"c.west\"\n",
      "list.toml", "list"));
  REQUIRE(presets.cases.size() == 2);
  CHECK(presets.cases[0].preset.block.size() == 2);
  const Preset& one = presets.cases[1].preset;
  REQUIRE(one.block.size() == 1);
  CHECK(one.block[0].name == "c");
  // the table of the case replaces that of the file
  CHECK(one.block[0].net.radius_mm == default_items().block[0].net.radius_mm);
  CHECK(one.join.size() == 1);
  // written again it is the same, and only where it differs
  const std::string text = to_toml(presets);
  CHECK(text.find("[[case.block]]") != text.npos);
  CHECK(text.find("[[case.block]]") == text.rfind("[[case.block]]"));
  const auto again = value_of(read_preset_text(text, "again.toml", "list"));
  CHECK(to_toml(again) == text);
}

TEST_CASE("an empty list of a case removes the file's items, also when it is written") {
  const auto presets = good(R"(
[[step]]
do = "rest"
[[case]]
name = "none"
step = []
[[case]]
name = "all"
)");
  REQUIRE(presets.cases.size() == 2);
  CHECK(presets.cases[0].preset.step.empty());
  CHECK(presets.cases[1].preset.step.size() == 1);
  const auto again = good(to_toml(presets));
  CHECK(again.cases[0].preset.step.empty());
  CHECK(again.cases[1].preset.step.size() == 1);
}

TEST_CASE("points are in the preset or in a file next to it") {
  const TemporaryFolder folder;
  const auto file = folder / "shell.toml";
  const auto with = [&](const std::string& points, const std::string& csv) {
    REQUIRE(write_file(folder / "edge.csv", csv));
    REQUIRE(write_file(
        file, "[footprint]\nkind = \"curve\"\nboundary = \"polygon\"\npoints_mm = " + points));
    return read_preset_file(file);
  };
  const Points square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  CHECK(with("[[-1, -1], [1, -1], [1, 1], [-1, 1]]", "")->base.footprint.boundary.points == square);
  CHECK(with("\"edge.csv\"", "x_mm, y_mm\n-1,-1\n1\t-1  # a corner\n\n1 1\r\n-1; 1")
            ->base.footprint.boundary.points == square);
  const auto wrong = [&](const std::string& points, const std::string& csv) {
    return with(points, csv).error().message;
  };
  const auto place = file.string() + ":4:13: [footprint] points_mm: ";
  const auto csv = (folder / "edge.csv").string();
  CHECK(wrong("\"edge.csv\"", "0 0\n1 2 3\n") ==
        place + csv + ":2: got 3 values, expected 2 numbers: x, y");
  CHECK(wrong("\"edge.csv\"", "0 0\n1 nan\n") ==
        place + csv + ":2: got 'nan', which is no number, expected 2 numbers: x, y");
  CHECK_THAT(wrong("\"edge.csv\"", "# nothing\n"), Catch::Contains("got no point"));
  CHECK_THAT(wrong("\"none.csv\"", ""), Catch::Contains("cannot read"));
  CHECK_THAT(wrong("[[1, 2, 3]]", ""),
             Catch::Contains("a point of 3 coordinates), expected a "
                             "list of points [x, y], or the name of a file"));
  CHECK_THAT(wrong("[[0, 0], [1, 1]]", ""), Catch::Contains("(2 points), expected at least 3"));
}

TEST_CASE("a file is read once all that says how is known, and reported") {
  const TemporaryFolder folder;
  const auto file = folder / "shell.toml";
  REQUIRE(write_file(folder / "grid.obj",
                     "v -0.03 0 0\nv 0.03 0 0\nv -0.01 -0.03 0\nv -0.01 0.03 0\nv 0.01 -0.03 0\n"
                     "v 0.01 0.03 0\nl 1 2\nl 3 4\nl 5 6\n"));
  const auto read = [&](const std::string& keys, const std::string& named,
                        const std::vector<Override>& overrides = {}) {
    REQUIRE(write_file(file, "[footprint]\nkind = \"network\"\nfile = \"" + named + "\"\n" + keys));
    return read_preset_file(file, overrides);
  };
  const auto metres = value_of(read("file_unit = \"m\"\n", "grid.obj"));
  CHECK(metres.base.footprint.file.points[1] == std::vector<double>{30, 0, 0});
  // the contents are stored in mm, and a written preset reads back as the same
  CHECK(metres.base.footprint.file_unit == FileUnit::file);
  CHECK(to_toml(good(to_toml(metres))) == to_toml(metres));
  REQUIRE(metres.files.size() == 1);
  CHECK_THAT(metres.files[0],
             Catch::Contains("grid.obj: unit by file_unit; 3 rods, 2 joints, 6 supports"));
  // an override replaces a missing file, and the unit
  const Override other{"--set", "footprint.file", (folder / "grid.obj").string()};
  CHECK(value_of(read("", "none.obj", {other})).base.footprint.file.points[1][0] == 0.03);
  CHECK(value_of(read("", "none.obj", {other, {"--set", "footprint.file_unit", "cm"}}))
            .base.footprint.file.points[1][0] == Approx(0.3));
  CHECK_THAT(refusal(read("", "none.obj")),
             Catch::Contains("shell.toml:3:8: [footprint] file: cannot read"));
  CHECK_THAT(
      errors_of("[footprint]\nkind = \"network\"\njoin_mm = 0.1\nfile = {points_mm = [[-9, 0, 0], "
                "[9, 0, 0], [0, 9, 0], [0, 0, 0]], rods = [[0, 3, 1], [3, 2]]}\n"),
      Catch::Contains("join_mm: got 0.1 (it is for a file"));
}

TEST_CASE("a file is read under its own name") {
  const TemporaryFolder folder;
  const auto file = folder / "small.toml";
  REQUIRE(write_file(file, "[footprint]\nrods = 6\n"));
  const auto presets = value_of(read_preset_file(file));
  CHECK(presets.base.name == "small");
  CHECK(presets.base.footprint.rods == 6);
  const auto missing = folder / "none.toml";
  CHECK(read_preset_file(missing).error().message ==
        "cannot read '" + missing.string() + "': No such file or directory");
  CHECK(read_preset_file(missing).error().fault == Fault::bad_input);
  CHECK(read_preset_file(folder).error().message ==
        "cannot read '" + folder.path().string() + "': Is a directory");
}
