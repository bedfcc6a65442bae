#include "engine/preset/sweep_grid.h"

#include "engine/core/file_io.h"
#include "tests/presets.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::preset;
using Catch::Contains;

namespace {

std::string over(const std::string& text) { return "[sweep.over]\n" + text + "\n"; }

}  // namespace

TEST_CASE("a grid of cases, values and seeds, in the order of the file") {
  const auto presets = good(R"(
[sweep]
seeds = 2
[sweep.over]
rod.young_GPa = [70, 83.0]
actuation.radius_mm = { from = 90, to = 110, count = 3 }
[[case]]
name = "a"
[[case]]
name = "b"
footprint.rods = 10
)");
  const SweepGrid grid(presets);
  REQUIRE(grid.size() == 2u * 2 * 3 * 2);
  // the key that is written first changes slowest, whatever its name
  CHECK(grid.sweep().over[0].key == "rod.young_GPa");
  CHECK(grid.sweep().over[1].values == std::vector<std::string>{"90.0", "100.0", "110.0"});
  const SweepPoint second = grid.at(1), last = grid.at(grid.size() - 1);
  CHECK(second.case_name == "a");
  CHECK(second.values == std::vector<std::string>{"70.0", "90.0"});
  CHECK(second.seed == 2);
  CHECK(second.preset.imperfection.seed == 2);
  CHECK(second.preset.actuation.radius_mm == 90);
  CHECK(last.preset.rod.young_GPa == 83);
  CHECK(last.preset.actuation.radius_mm == 110);
  CHECK(last.preset.footprint.rods == 10);
  CHECK(grid.at(2).preset.actuation.radius_mm == 100);
}

TEST_CASE("a swept material gives its values, but those that are swept too") {
  const SweepGrid grid(good(over("rod.material = [\"steel\", \"spruce\", \"none\"]")));
  CHECK(grid.at(0).preset.rod.young_GPa == 210);
  CHECK(grid.at(1).preset.rod.young_GPa == 11);
  CHECK(grid.at(1).preset.rod.strength_MPa == 24);
  CHECK(grid.at(2).preset.rod == Rod());
  const SweepGrid two(good(over("rod_v.material = [\"steel\"]\nrod_v.yield_strain = [0.01]\n"
                                "rod_v.young_GPa = [200, 210]") +
                           "[rod_v]\ndiffers = true\n"));
  CHECK(two.at(0).preset.rod_v.young_GPa == 200);
  CHECK(two.at(0).preset.rod_v.density_kg_m3 == 7850);
  CHECK(two.at(0).preset.rod_v.strength_MPa == 0);
  // what would have no effect is refused
  const std::string swept = over("rod.material = [\"steel\", \"none\"]");
  CHECK_THAT(errors_of(swept, {{"--set", "rod.shear_GPa", "2"}}),
             Contains("[rod] shear_GPa: got a value from the command line, but [sweep] over "
                      "rod.material decides it, expected one of the two"));
  CHECK_THAT(errors_of(swept + "[rod]\nmaterial = \"oak\"\n"), Contains("got \"none\" and"));
}

TEST_CASE("points of a sweep need not have the stills of its base") {
  const auto presets =
      good("[figure]\nradii_mm = [126.0, 94.5]\n" + over("actuation.ratio = [0.9, 0.8]"));
  CHECK(SweepGrid(presets).at(0).preset.actuated_radius_mm() == Approx(0.9 * 126));
}

TEST_CASE("a swept file is next to the preset, and read by its other keys") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text, const std::vector<Override>& overrides = {}) {
    REQUIRE(write_file(folder / "own.toml", text));
    return read_preset_file(folder / "own.toml", overrides);
  };
  REQUIRE(write_file(folder / "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nl 1 2 3 4 1\n"));
  const std::string text =
      "[footprint]\nkind = \"curve\"\nboundary = \"file\"\nfile = \"a.obj\"\nfile_unit = \"m\"\n" +
      over("footprint.file = [\"a.obj\"]");
  const SweepGrid grid(value_of(read(text)));
  const auto found = grid.at(0).preset.footprint;
  REQUIRE(found.file.points.size() == 4);
  CHECK(found.file.points[2] == std::vector<double>{1000, 1000, 0});
  CHECK(found.file_unit == FileUnit::file);
  CHECK_THAT(refusal(read(text, {{"--set", "footprint.file_unit", "mm"}})),
             Contains("[footprint] file_unit: got a value from the command line, but [sweep] over "
                      "footprint.file"));
}

TEST_CASE("a still at the end of the path is on it, whatever the ratio rounds to") {
  CHECK(
      good(
          "[footprint]\nrods = 6\nradius_mm = 66.0\n[actuation]\nratio = 0.8\n[figure]\nradii_mm = "
          "[52.8]\n")
          .base.figure.radii_mm.size() == 1);
}

TEST_CASE("searches for states perturb differently at every point, and equally when repeated") {
  const auto seeds_of = [](const std::string& text) {
    const auto presets = good(text);
    const SweepGrid grid(presets);
    std::vector<int> seeds;
    for (std::size_t k = 0; k < grid.size(); ++k) seeds.push_back(grid.at(k).preset.jitter.seed);
    return seeds;
  };
  const std::string search = "[jitter]\ntrials = 3\nseed = 7\n";
  CHECK(
      seeds_of(search + over("footprint.longest_leg = [0.5, 1.0, 2.0]\nactuation.ratio = [0.8]")) ==
      std::vector<int>{7, 8, 9});
  CHECK(seeds_of("[jitter]\ntrials = 3\n" + over("jitter.seed = [4, 2]")) ==
        std::vector<int>{4, 2});
  // the largest seed there is
  CHECK(seeds_of("[jitter]\ntrials = 3\nseed = 1073741824\n" + over("rod.young_GPa = [70, 80]")) ==
        std::vector<int>{1073741824, 0});
  // without a search for states all points have the seed of the preset
  CHECK(seeds_of(over("rod.young_GPa = [70, 80]")) == std::vector<int>{1, 1});
}

TEST_CASE("values of every kind, ranges of integers, even factors") {
  const auto presets = good(over(R"(actuation.seed = ["up", "down"]
footprint.rods = { from = 8, to = 16, count = 5 }
rod.diameter_mm = { from = 0.1, to = 10, count = 3, log = true }
indentation.unload = [true, false]
indentation.depth_mm = [1])"));
  const auto& axes = presets.base.sweep.over;
  CHECK(axes[0].values == std::vector<std::string>{"\"up\"", "\"down\""});
  CHECK(axes[1].values == std::vector<std::string>{"8", "10", "12", "14", "16"});
  CHECK(axes[2].values == std::vector<std::string>{"0.1", "1.0", "10.0"});
  CHECK(axes[3].values == std::vector<std::string>{"true", "false"});
}

TEST_CASE("a sweep is printed as a preset that sweeps the same") {
  const auto presets = good("[sweep]\nseeds = 3\nplot = [\"total_K\"]\n" +
                            over("rod.young_GPa = { from = 70, to = 90, count = 3 }"));
  const auto again = good(to_toml(presets));
  CHECK(to_toml(again) == to_toml(presets));
  CHECK(again.base.sweep.over[0].values == presets.base.sweep.over[0].values);
  // a preset without a sweep is written without the table
  CHECK_THAT(to_toml(Preset{}), !Contains("sweep"));
}

TEST_CASE("a sweep is laid over by the command line") {
  const Override change{"--set", "sweep.over", "{rod.diameter_mm=[0.2,0.3]}"};
  const auto presets = good("", {change});
  CHECK(SweepGrid(presets).size() == 2);
  CHECK(SweepGrid(good("")).size() == 0);
}

TEST_CASE("hostile sweeps are reported with file, line and key") {
  CHECK_THAT(errors_of(over("rod.diametre_mm = [0.2]")),
             Contains("bad.toml:2:") && Contains("[sweep.over] rod.diametre_mm: got ") &&
                 Contains("did you mean 'rod.diameter_mm'?"));
  for (const char* key : {"step.depth_mm", "\"step.2.depth_mm\"", "loads.case.snow"})
    CHECK_THAT(errors_of(over(std::string(key) + " = [1.0, 2.0]")),
               Contains("bad.toml:2:") && Contains("expected a key that exists once"));
  CHECK_THAT(errors_of(over("rod.diameter_mm = []")),
             Contains("bad.toml:2:") && Contains("(an empty list), expected values"));
  CHECK_THAT(
      errors_of(over("rod.diameter_mm = [0.2,\n\"thick\"]")),
      Contains("bad.toml:3:1") &&
          Contains("[sweep.over] rod.diameter_mm: got \"thick\" (a string), expected a number"));
  CHECK_THAT(errors_of(over("rod.diameter_mm = [0.2, -1, nan]")),
             Contains("-1 (out of range)") && Contains("nan (not finite)"));
  CHECK_THAT(errors_of(over("rod.diameter_mm = 0.2")),
             Contains("expected a list of values or { from, to, count }"));
  CHECK_THAT(errors_of(over("rod.diameter_mm = [0.2, 0.20]")), Contains("(in the list twice)"));
  CHECK_THAT(errors_of(over("rod.diameter_mm = {from = 1, to = 2, cuont = 3}")),
             Contains("unknown 'cuont'; did you mean 'count'?"));
  CHECK_THAT(errors_of(over("rod.diameter_mm = {from = -1, to = 2, count = 3, log = true}")),
             Contains("log = true: expected from and to above 0"));
  CHECK_THAT(errors_of(over("rod.diameter_mm = {from = 1e-320, to = 1, count = 3}")),
             Contains("(too small to compute with)"));
  CHECK_THAT(errors_of(over("footprint.rods = {from = 4, to = 9, count = 3}")),
             Contains("(gives 6.5), expected an integer"));
  CHECK_THAT(errors_of(over("movie.frames = [3]")), Contains("no number of a run depends on it"));
  CHECK_THAT(errors_of("[sweep]\nover = 3"), Contains("bad.toml:2:") && Contains("(an integer)"));
  CHECK_THAT(errors_of("[sweep]\nover = {rod = {diameter_mm = {from = 1}}}"),
             Contains("expected { from"));
  CHECK_THAT(errors_of(over("net.waist = [0.2]")),
             Contains("[net] waist has no effect in any of the runs"));
  CHECK_THAT(errors_of(over("actuation.radius_mm = [90, 200]")),
             Contains("bad.toml:1:") && Contains("at actuation.radius_mm = 200.0") &&
                 Contains("larger than the footprint"));
  CHECK_THAT(errors_of("[[case]]\nname = \"a\"\nsweep.seeds = 3"),
             Contains("bad.toml:3:") && Contains("expected one outside of cases"));
  CHECK_THAT(errors_of(over("rod.young_GPa = [1]") + "[[case]]\nname = \"a\"\nrod.young_GPa = 2"),
             Contains("got a value from a case, but [sweep] over rod.young_GPa decides it"));
  CHECK_THAT(errors_of(over("rod.young_GPa = [1]"), {{"--set", "rod.young_GPa", "2"}}),
             Contains("got a value from the command line, but [sweep] over"));
  CHECK_THAT(errors_of("[imperfection]\nsize = 0.0\n[sweep]\nseeds = 3"),
             Contains("has no effect"));
  CHECK_THAT(errors_of("[sweep]\nseeds = 100000\n" +
                       over("rod.young_GPa = {from = 1, to = 2, count = 100000}")),
             Contains("expected at most 100000"));
}

TEST_CASE("a swept key may be written in quotes") {
  const SweepGrid grid(good(over("\"rod.young_GPa\" = [70, 83.0]")));
  CHECK(grid.sweep().over[0].key == "rod.young_GPa");
  CHECK(grid.at(1).preset.rod.young_GPa == 83);
}
