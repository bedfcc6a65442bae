// Complete searches for states, on shells so small that they take seconds.
#include "app/cli/preset_library.h"
#include "tests/app/bench.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

const std::string search =
    small_preset({.rods = 4, .radius_mm = 46, .actuated_mm = 34, .edges = 4}) +
    "[jitter]\ntrials = 8\nconfined = 4\ntransitions = 2\nbarriers = true\ndepth = 0.5\n";

}  // namespace

TEST_CASE("a search for states: tables, pictures, and the same pictures again from the run",
          "[standard]") {
  const TemporaryFolder at;
  REQUIRE(write_file(at / "shell.toml", search));
  good("figure shell.toml --threads 1", at);
  const fs::path run = at / "out" / "shell_figure";
  const auto tables = value_of(gridshell::record::read_state_tables(run));
  REQUIRE(!tables.rows.empty());
  CHECK(tables.search.trials == 8);
  CHECK(tables.search.at_rest >= 7);
  for (const char* name : {"shell.png", "shell_1.png", "shell_energies.svg", "shell_lives.png"})
    CHECK(fs::exists(run / name));
  good("figure shell.toml --threads 2 -o two", at);
  for (const char* name : {"states.csv", "transitions.csv", "barriers.csv", "frames.csv",
                           "shell.png", "shell_transitions.svg", "shell_barriers.svg"})
    CHECK(text_of(run / name) == text_of(at / "two" / name));
  good("render out/shell_figure -o again", at);
  for (const char* name : {"shell.png", "shell_energies.png", "states.csv", "states.json"})
    CHECK(text_of(run / name) == text_of(at / "again" / name));
  // a state of unknown range is left out, and the others keep their radii
  auto unknown = tables;
  unknown.rows[0].lives_to = unknown.rows[0].lives_to_radius_mm = record::unknown;
  REQUIRE(record::write_state_tables(run, unknown));
  good("render out/shell_figure -o known", at);
  CHECK_THAT(
      text_of(at / "known/shell_lives.svg"),
      Contains("up to Ra (mm)") &&
          Contains(fmt::format("that of 1 of the {} states is not known", tables.rows.size())));
}

TEST_CASE("states and a finished sweep's phase diagram are on one page", "[standard]") {
  const TemporaryFolder at;
  const std::string shell =
      "[footprint]\nkind = \"circle\"\n{}[actuation]\nratio = 0.75\n"
      "[accuracy]\nedges_per_segment = 8\n[jitter]\ntrials = 3\nconfined = 7\n";
  const auto with = [&](const std::string& more) {
    std::string text = shell;
    return text.replace(text.find("{}"), 2, more);
  };
  REQUIRE(write_file(at / "page.toml", with("rods = 4\nlongest_leg = 0.8\n") +
                                           "[page]\nkind = \"fig2\"\n[movie]\nsize = "
                                           "[320, 240]\n[figure]\nquality = \"draft\"\n"));
  REQUIRE(write_file(at / "sweep.toml", with("") + "[sweep]\nplot = [\"classes\"]\n"
                                                   "[sweep.over]\nfootprint.rods = [4]\n"
                                                   "footprint.longest_leg = [0.8, 2.0]\n"));
  // without a sweep its box is an empty frame that says so
  good("figure page.toml --quiet", at);
  const std::string empty = text_of(at / "out/page_figure/page_page.svg");
  CHECK_THAT(empty, Contains("names no sweep") && !Contains("longest leg"));
  // the foot names no state, since only domes and others were found
  CHECK_THAT(empty, Contains("none of the states ii, iii and iv was found"));
  CHECK_THAT(empty, !Contains("A1") && !Contains("A4") && Contains("d = 20 mm"));
  good("sweep sweep.toml --quiet", at);
  // drawn again with the sweep, with pictures of the shells too
  good("render out/page_figure -o again --quiet --set page.sweep=out/sweep --set page.drawn=true",
       at);
  const std::string page = text_of(at / "again/page_page.svg");
  CHECK_THAT(page, Contains("longest leg") && !Contains("names no sweep"));
  CHECK(fs::exists(at / "again/page_page.pdf"));
  CHECK(fs::exists(at / "again/page_page_drawn.svg"));
  // a folder without a sweep, and a sweep that is not finished
  const auto refused = [&](const std::string& named) {
    const Ended ended = gridshell_program(
        {"render", "out/page_figure", "-o", "not", "--quiet", "--set", "page.sweep=" + named}, at);
    CHECK(ended.code == 2);
    CHECK_FALSE(fs::exists(at / "not"));
    return ended.err;
  };
  CHECK_THAT(refused("nowhere"), Contains("no finished sweep") && Contains("nowhere"));
  const std::string table = text_of(at / "out/sweep/sweep.csv");
  REQUIRE(write_file(at / "cut.csv", table.substr(0, table.size() - 40)));
  CHECK_THAT(refused("cut.csv"), Contains("'cut.csv' is no table of a sweep: line 3"));
  fs::remove(at / "out/sweep/sweep.csv");
  CHECK_THAT(refused("out/sweep"), Contains("no finished sweep"));
}

TEST_CASE("points of the shipped phase diagram are computed again with equal results",
          "[standard]") {
  const std::string& text = app::embedded_files().at("fig2_phase_diagram.csv");
  const auto shipped = value_of(record::read_sweep_csv(text));
  CHECK(shipped.rows.size() == 207);
  CHECK(record::sweep_csv(shipped) == text);
  const TemporaryFolder folder;
  for (const std::size_t k : {9, 11, 199}) {
    const record::SweepTable::Row& row = shipped.rows.at(k);
    INFO("point " << k);
    const auto figure = [](const record::PointResult& of, const char* name) {
      return record::number_of(of.figure(name) ? *of.figure(name) : record::Figure());
    };
    std::string preset =
        std::ranges::find(app::embedded_presets(), "fig2_phase_diagram", &app::EmbeddedPreset::name)
            ->text;
    preset.resize(preset.find("[sweep.over]"));
    preset += fmt::format("[sweep.over]\n{} = [{}]\n{} = [{}]\n", shipped.axes[0],
                          row.keys.values[0], shipped.axes[1], row.keys.values[1]);
    REQUIRE(write_file(folder / "point.toml", preset));
    good({"sweep", "point.toml", "-o", std::to_string(k), "--quiet", "--set",
          fmt::format("jitter.seed={}", figure(row.result, "jitter_seed"))},
         folder);
    const auto again =
        value_of(record::read_sweep_csv(text_of(folder / std::to_string(k) / "sweep.csv")));
    for (const char* name : {"states", "at_rest", "states_i", "met_i", "states_ii", "met_ii",
                             "met_confined_ii", "states_iv", "states_other", "met_other"})
      CHECK(figure(again.rows.front().result, name) == figure(row.result, name));
    CHECK_THAT(figure(again.rows.front().result, "height_mm"),
               Catch::Matchers::WithinAbs(figure(row.result, "height_mm"), 1e-6));
  }
}

TEST_CASE("joints measured lie over a state of a page of states", "[standard]") {
  const TemporaryFolder at;
  REQUIRE(write_file(
      at / "page.toml",
      "[footprint]\nkind = \"circle\"\nrods = 6\nlongest_leg = 0.4\n[actuation]\nratio = 0.75\n"
      "[accuracy]\nedges_per_segment = 4\n[jitter]\ntrials = 2\nconfined = 7\n"
      "[page]\nkind = \"fig2\"\n[movie]\nsize = [320, 240]\n[figure]\nquality = \"draft\"\n"));
  good("figure page.toml --quiet", at);
  // two states and no dome are found
  CHECK_THAT(text_of(at / "out/page_figure/page_page.svg"),
             !Contains("joints measured") && Contains("A1–A2 at (L̄d, n) = (0.4, 6); d = 20 mm"));
  const Ended drawn = good({"render", "out/page_figure", "-o", "again", "--quiet", "--set",
                            "figure.scan=[[0, 0, 20], [10, 10, 18]]"},
                           at);
  CHECK(text_of(at / "again/page_page.svg").find("joints measured") != std::string::npos);
}

TEST_CASE("a search for states has no movie, and damaged tables are refused") {
  const TemporaryFolder at;
  REQUIRE(write_file(at / "shell.toml", search));
  check_refused("movie shell.toml", at, Contains("gridshell figure"));
  good("run shell.toml", at);
  REQUIRE(write_file(at / "out/shell/states.csv", "state\n"));
  check_refused("render out/shell -o again", at, Contains("states.csv"));
}

TEST_CASE("keys of a search that its mode does not use are refused with the reason") {
  const TemporaryFolder folder;
  REQUIRE(write_file(folder / "shell.toml", search + "field_N_per_mm = 0.5\n"));
  check_refused("check shell.toml", folder, Contains("gravity"));
}
