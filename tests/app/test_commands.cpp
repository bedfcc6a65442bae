// Complete runs of the commands, on a shell so small that they take seconds.
#include <nlohmann/json.hpp>

#include "render/gl/image.h"
#include "tests/app/bench.h"
#include "tests/results.h"

namespace {

const std::string small = small_preset({.frames = 3});
const std::string two_cases =
    small + "[[case]]\nname = \"near\"\nactuation.radius_mm = 43.0\n[[case]]\nname = \"far\"\n";

const std::vector<std::string> data_files{"bins.csv",     "cells.csv",   "frames.csv",
                                          "joints.csv",   "preset.toml", "summary.json",
                                          "trajectory.h5"};

// adds manifest.txt, which every folder of a command has, to names of files
std::vector<std::string> listed(std::vector<std::string> names) {
  names.push_back("manifest.txt");
  std::sort(names.begin(), names.end());
  return names;
}

// names in the folder, without movie.mp4, which exists only if ffmpeg is installed
std::vector<std::string> files_in(const fs::path& folder) {
  auto names = names_in(folder);
  std::erase(names, "movie.mp4");
  return names;
}

nlohmann::json json_of(const fs::path& file) { return nlohmann::json::parse(text_of(file)); }

// the frames of a run, read back
gridshell::record::FrameList frames_of(const fs::path& run) {
  return value_of(gridshell::record::read_trajectory(run / "trajectory.h5")).frames;
}

// width of a picture
int width_of(const fs::path& file) { return value_of(gridshell::render::read_png(file)).width; }

}  // namespace

TEST_CASE("run writes a complete run folder and replaces the one before") {
  const Bench bench(small);
  bench.good("run small.toml");
  const auto run = bench.at / "out/small";
  CHECK(files_in(run) == listed(data_files));
  CHECK(files_in(bench.at / "out") == std::vector<std::string>{"small"});
  CHECK(json_of(run / "summary.json")["preset"] == "small");
  CHECK(frames_of(run).size() == 3);
  CHECK(json_of(run / "summary.json")["kind"] == "run");
  CHECK(json_of(run / "summary.json")["finished"] == true);
  // a movie replaces the run; a run does not replace the movie
  bench.good("movie small.toml");
  CHECK(json_of(run / "summary.json")["kind"] == "movie");
  CHECK(fs::exists(run / "frames"));
  check_refused("run small.toml --frames 4", bench.at, Contains("made by 'gridshell movie'"));
  CHECK(frames_of(run).size() == 3);
  bench.good("movie small.toml --frames 4");
  CHECK(frames_of(run).size() == 4);
  CHECK(files_in(bench.at / "out") == std::vector<std::string>{"small"});
  // stills have a folder of their own
  bench.good("figure small.toml");
  CHECK(files_in(bench.at / "out") == std::vector<std::string>{"small", "small_figure"});
  CHECK(frames_of(run).size() == 4);
  CHECK(json_of(bench.at / "out/small_figure/summary.json")["kind"] == "figure");
}

TEST_CASE("the same preset gives the same frames, from the run's own preset.toml too") {
  const Bench bench(small);
  bench.good("run small.toml -o a --set rod.diameter_mm=0.3");
  bench.good("run a/preset.toml -o b");
  CHECK(text_of(bench.at / "a/frames.csv") == text_of(bench.at / "b/frames.csv"));
  CHECK(text_of(bench.at / "a/preset.toml") == text_of(bench.at / "b/preset.toml"));
  bench.good("run small.toml -o c");
  CHECK(text_of(bench.at / "a/frames.csv") != text_of(bench.at / "c/frames.csv"));
}

TEST_CASE("a printed config (--print-config) gives the same preset, and nothing runs") {
  const Bench bench(small);
  const auto first = bench.good(
      "movie small.toml --set actuation.seed=down --size 320x200 --frames 9 --print-config");
  CHECK_THAT(first.out, Contains("seed = \"down\"") && Contains("size = [320, 200]") &&
                            Contains("frames = 9"));
  REQUIRE(write_file(bench.at / "again.toml", first.out));
  CHECK(bench.good("movie again.toml --print-config").out == first.out);
  CHECK_FALSE(fs::exists(bench.at / "out"));
}

TEST_CASE("movie draws every frame, and render draws them again without simulating") {
  const Bench bench(small);
  const auto said = bench.good("movie small.toml -o run");
  CHECK_THAT(said.out, Catch::StartsWith("run: "));
  const auto frames = files_under(bench.at / "run/frames", ".png");
  REQUIRE(frames.size() == 3);
  CHECK(frames[2].filename() == "frame_00002.png");
  const auto picture = gridshell::value_of(gridshell::render::read_png(frames[2]));
  CHECK(picture.width == 160);
  CHECK(picture.height == 120);
  CHECK(json_of(bench.at / "run/summary.json")["seconds_render"] > 0.0);

  const auto bytes = text_of(frames[2]), states = text_of(bench.at / "run/frames.csv");
  bench.good("render run -o same");
  CHECK(text_of(bench.at / "same/frames/frame_00002.png") == bytes);
  CHECK(text_of(bench.at / "same/frames.csv") == states);
  bench.good("render run --size 80x60 --quiet");
  CHECK(width_of(frames[2]) == 80);
  check_refused("render run --set rod.diameter_mm=0.3", bench.at,
                Catch::Equals("--set: rod.diameter_mm cannot change once a run is finished; what "
                              "can are keys of [movie], [style], [figure] and [page] that only "
                              "show it\n"));
}

TEST_CASE("a turntable is the last state of a run, seen once around") {
  const Bench bench(small);
  bench.good("run small.toml -o out/run");
  const auto said = bench.good("movie out/run --turntable --frames 4 --size 160x120");
  CHECK_THAT(said.out, Catch::StartsWith("out/run_turntable: 4 frames"));
  const auto frames = files_under(bench.at / "out/run_turntable/frames", ".png");
  REQUIRE(frames.size() == 4);
  CHECK(text_of(frames[0]) != text_of(frames[2]));
  check_refused("movie out/run", bench.at,
                Contains("the folder of a run") && Contains("gridshell render out/run"));
  // a turntable replaces the folder of a turntable, but not that of the run
  bench.good("movie out/run --turntable --frames 2 --size 160x120 --quiet");
  check_refused("movie out/run --turntable -o out/run", bench.at, Contains("out/run"));
  check_refused("movie out/run --turntable --frames 1", bench.at, Contains("expected 2 to"));
}

TEST_CASE("pictures do not depend on the number of threads", "[standard]") {
  const Bench bench(small);
  bench.good("movie small.toml -o one --threads 1 --quality figure");
  bench.good("movie small.toml -o three --threads 3 --quality figure");
  for (const char* frame : {"frames/frame_00000.png", "frames/frame_00002.png"})
    CHECK(text_of(bench.at / "one" / frame) == text_of(bench.at / "three" / frame));
  CHECK(text_of(bench.at / "one/frames.csv") == text_of(bench.at / "three/frames.csv"));
}

TEST_CASE("figure draws a still for every radius and one with all", "[standard]") {
  const Bench bench(small);
  bench.good({"figure", "small.toml", "-o", "run", "--set", "figure.radii_mm=[45.0, 42.0]"});
  std::vector<std::string> names;
  for (const auto& file : files_under(bench.at / "run", ".png"))
    names.push_back(file.filename().string());
  CHECK(names == std::vector<std::string>{"small.png", "small_1.png", "small_2.png"});
  const auto states = frames_of(bench.at / "run");
  REQUIRE(states.size() == 2);
  CHECK(states[1].boundary_radius_mm == Approx(42.0));
  // render draws the stills of a figure again as stills
  bench.good("render run -o again");
  CHECK(fs::exists(bench.at / "again/small_2.png"));
  CHECK_FALSE(fs::exists(bench.at / "again/frames"));
}

TEST_CASE("figure draws where the cases end, side by side", "[standard]") {
  const Bench bench(two_cases);
  bench.good("figure small.toml -o run");
  CHECK(files_in(bench.at / "run") ==
        listed({"far", "near", "preset.toml", "small.png", "summary.json"}));
  CHECK(width_of(bench.at / "run/small.png") > 1.5 * width_of(bench.at / "run/near/near.png"));
}

TEST_CASE("figures of building blocks, drawn again from the run", "[shared]") {
  const fs::path run = shared_run("fig5_peanut");
  CHECK_THAT(text_of(fs::path(run) += ".txt"),
             Contains("mm from its blocks at most; seams: gap 5.38 mm"));
  const TemporaryFolder at;
  good({"render", run.string(), "-o", "again", "--quiet"}, at);
  CHECK(files_in(at / "again") == files_in(run));
  const auto pictures = files_under(run, ".png");
  CHECK(pictures.size() == 9);
  for (const fs::path& picture : pictures) {
    INFO(picture);
    CHECK(text_of(at / "again" / picture.filename().string()) == text_of(picture));
  }
}

TEST_CASE("every case is a complete run folder, and summary.json on top lists them") {
  const Bench bench(two_cases);
  bench.good("movie small.toml -o run --set movie.beside=false");
  CHECK(files_in(bench.at / "run") == listed({"far", "near", "preset.toml", "summary.json"}));
  auto movie_files = data_files;
  movie_files.push_back("frames");
  std::sort(movie_files.begin(), movie_files.end());
  for (const char* name : {"near", "far"}) {
    CHECK(files_in(bench.at / "run" / name) == movie_files);
    CHECK(files_under(bench.at / "run" / name / "frames", ".png").size() == 3);
  }
  const auto top = json_of(bench.at / "run/summary.json");
  CHECK(top["preset"] == "small");
  REQUIRE(top["cases"].size() == 2);
  CHECK(top["cases"][0]["name"] == "near");
  CHECK(top["cases"][0]["height_mm"] < top["cases"][1]["height_mm"]);
  CHECK(top["cases"][1]["height_mm"] == json_of(bench.at / "run/far/summary.json")["height_mm"]);
  bench.good("render run --size 80x60");
  CHECK(width_of(bench.at / "run/near/frames/frame_00000.png") == 80);
}

TEST_CASE("cases are shown side by side in one movie, drawn again by render") {
  const Bench bench(two_cases);
  bench.good({"movie", "small.toml", "-o", "run", "--set", "title=Two shells"});
  CHECK(files_in(bench.at / "run") ==
        listed({"far", "frames", "near", "preset.toml", "summary.json"}));
  // render draws the common title again, too
  bench.good("render run -o again");
  CHECK(text_of(bench.at / "run/frames/frame_00002.png") ==
        text_of(bench.at / "again/frames/frame_00002.png"));
  CHECK(files_in(bench.at / "run/near") == data_files);
  CHECK(files_under(bench.at / "run/frames", ".png").size() == 3);
  bench.good("render run --size 120x90");
  CHECK(files_under(bench.at / "run/frames", ".png").size() == 3);
  CHECK(width_of(bench.at / "run/frames/frame_00000.png") == 120);
  CHECK(files_in(bench.at / "run/near") == data_files);
}

TEST_CASE("a path that ends early is written as far as it is certified, and exits with 1") {
  const Bench bench(small);
  const auto ended = bench.run("run small.toml --set limits.max_strain=1e-7");
  CHECK(ended.code == 1);
  CHECK_THAT(ended.err, Contains("the path ended early, limit \"locking\": "));
  CHECK(json_of(bench.at / "out/small/summary.json")["limit"] == "locking");
}

TEST_CASE("a run says on the terminal what its path came past", "[shared]") {
  CHECK_THAT(text_of(shared_run("s1_imperfect") += ".txt"),
             Contains("on its path: the path branches at progress 0.018"));
}

TEST_CASE("check reports what it read from each file, and values that may be mistakes") {
  const Bench bench(small);
  REQUIRE(
      write_file(bench.at / "net.toml", "[footprint]\nkind = \"network\"\nfile = \"net.obj\"\n"));
  const std::string rods =
      "v -30 0 0\nv 30 0 0\nv -10 -30 0\nv -10 30 0\nv 10 -30 0\nv 10 9.996 0\n"
      "v 10 10.004 0\nv 10 30 0\nl 1 2\nl 3 4\nl 5 6\nl 7 8\n";
  REQUIRE(write_file(bench.at / "net.obj", rods + "v -30 20 0\nv 30 20 0\nl 9 10\n"));
  const auto loose = bench.good("check net.toml --set rod.young_GPa=83000");
  CHECK_THAT(loose.out,
             Contains("net.obj: in mm, as OBJ names no unit; 5 rods, 4 joints, 10 sup") &&
                 Contains("[footprint] join_mm = 0.0088 joins them") &&
                 Contains("stiffer than any material"));
  const auto joined = bench.good("check net.toml --set footprint.join_mm=0.01");
  CHECK_THAT(joined.out, Contains("4 rods, 4 joints, 8 supports") && !Contains("note"));
  // the hint is part of a refusal as well, because the small gap may be its cause
  REQUIRE(write_file(bench.at / "net.obj", rods));
  check_refused("check net.toml", bench.at,
                Contains("got a rod without a joint") && Contains("join_mm = 0.0088 joins them"));
}

TEST_CASE("a preset comes through a pipe") {
  const Bench bench(small);
  const std::string line = std::string("cat small.toml | ") + GRIDSHELL_PROGRAM + " check -";
  const auto said = Running({"-c", line}, bench.at, "/bin/sh").wait();
  CHECK(said.code == 0);
  CHECK_THAT(said.out, Contains("pipe: "));
}

TEST_CASE("check explains what would run and writes nothing") {
  const Bench bench(small);
  const auto said = bench.good("check small.toml");
  CHECK_THAT(said.out, Contains("small: small") && Contains("model") && Contains("unknowns") &&
                           Contains("8 rods") && !Contains("left out") &&
                           Contains("longest leg L_d = 0.75"));
  const auto thick = bench.good("check small.toml --set rod.diameter_mm=8");
  CHECK_THAT(thick.out, Contains("left out        rods of 8 mm are 2.5 diameters long") &&
                            Contains("some 35 % more, and the 8 mm between the axes"));
  CHECK(bench.folder.entries() == std::vector<std::string>{"small.toml"});
}

TEST_CASE("list has a line for every preset, and check accepts each", "[standard]") {
  const TemporaryFolder folder;
  const auto said = good("list", folder);
  CHECK_THAT(said.out, Contains("s1_actuation") && Contains("fig1_actuation"));
  std::istringstream lines(said.out);
  int presets = 0;
  for (std::string line; std::getline(lines, line); ++presets) {
    const auto name = line.substr(0, line.find(' '));
    INFO(name);
    CHECK(gridshell_program({"check", name}, folder).code == 0);
  }
  CHECK(presets == int(files_under(fs::path(GRIDSHELL_SOURCE_DIR) / "presets", ".toml").size()));
}

TEST_CASE("compare reports equal or different by its exit code") {
  const TemporaryFolder folder;
  gridshell::render::Image plain(64, 64), rod = plain;
  for (std::size_t k = 3; k < plain.rgba.size(); k += 4) plain.rgba[k] = rod.rgba[k] = 255;
  for (int x = 0; x < 64; ++x) rod.pixel(x, 30)[0] = 200;
  REQUIRE(gridshell::render::write_png(plain, folder / "a.png"));
  REQUIRE(gridshell::render::write_png(rod, folder / "b.png"));
  CHECK(gridshell_program("compare a.png a.png", folder).code == 0);
  const auto said = gridshell_program("compare a.png b.png --difference d.png", folder);
  CHECK(said.code == 3);
  // one of eight rows differs by 200, so the mean of a block of eight differs by 25
  CHECK_THAT(said.out, Catch::StartsWith("different: ") && Contains("differs by 25.00"));
  CHECK(gridshell::render::read_png(folder / "d.png"));
  CHECK(gridshell_program("compare a.png b.png --threshold 26", folder).code == 0);
}

TEST_CASE("usage errors exit with 2, help with 0") {
  const TemporaryFolder folder;
  for (const char* wrong :
       {"", "movie", "run s1_actuation --treads 2", "run s1_actuation --threads 0",
        "movie s1_actuation --context x", "chart speed s1_actuation", "chart accuracy",
        "chart accuracy s1_actuation --limit 0"}) {
    INFO(wrong);
    CHECK(gridshell_program(wrong, folder).code == 2);
  }
  check_refused({"run", "s1_actuation", "-o", ""}, folder, Contains("expected a folder"));
  good("--help", folder);
  good("movie --help", folder);
  CHECK(folder.entries().empty());
}

TEST_CASE("chart accuracy --sizes draws a curve for every number of rods") {
  const Bench bench(small);
  const auto said = bench.good("chart accuracy small.toml --sizes 5,6 --edges 16 -o sizes");
  CHECK_THAT(said.out, Contains("5 rods: ") && Contains("6 rods: "));
  const auto table = text_of(bench.at / "sizes/accuracy.csv");
  // 1e-2 and 1e-3 lead to the same meshes
  CHECK(std::ranges::count(table, '\n') == 5);
  CHECK_THAT(table, Contains("\n5 rods,") && Contains("\n6 rods,"));
  CHECK(fs::exists(bench.at / "sizes/accuracy.png"));
  CHECK_THAT(bench.run("chart accuracy small.toml --sizes 5,many").err,
             Contains("'many' is no number of rods"));
  CHECK(bench.run("chart accuracy net_barrel --sizes 8").code == 2);
}

TEST_CASE("chart accuracy writes tables and pictures and reports how auto does", "[full]") {
  const Bench bench(small);
  const auto said = bench.good("chart accuracy small.toml --limit 0.05 --edges 4");
  CHECK_THAT(said.out, Contains("auto at 1e-06: error"));
  const auto folder = bench.at / "out/small_accuracy";
  CHECK(files_in(folder) ==
        listed({"accuracy.csv", "accuracy.pdf", "accuracy.png", "accuracy.svg", "preset.toml",
                "scaling.csv", "scaling.pdf", "scaling.png", "scaling.svg", "summary.json",
                "unknowns.pdf", "unknowns.png", "unknowns.svg"}));
  CHECK(json_of(folder / "summary.json")["chart"] == "accuracy");
  // the folder of stability maps is next to that of accuracy; the next chart replaces it
  const auto maps = bench.good("chart stability small.toml --limit 0.05");
  CHECK_THAT(maps.out, Contains("default: ") && Contains(" 0 silently wrong"));
  CHECK(files_in(bench.at / "out/small_stability") ==
        listed({"preset.toml", "stability.csv", "stability.pdf", "stability.png", "stability.svg",
                "summary.json"}));
  bench.good("chart stability small.toml --limit 0.01 --quiet");
}

TEST_CASE("report puts a run into one PDF, with what it carries and how it sways", "[standard]") {
  const Bench bench(small +
                    "[rod]\ndensity_kg_m3 = 6450.0\nstrength_MPa = 900.0\n"
                    "[loads]\nsnow_N_m2 = 0.5\n[[loads.case]]\nname = \"snow\"\nsnow = 1.0\n");
  bench.good("run small.toml");
  CHECK_THAT(bench.good("report out/small/ --count 2").out, Contains("out/small_report.pdf"));
  const std::string pdf = text_of(bench.at / "out/small_report.pdf");
  CHECK_THAT(pdf, Catch::StartsWith("%PDF"));
  CHECK(pdf.size() > 20000);
  // a report without frequencies, as the density is unknown, is no failure
  bench.good("run small.toml --set rod.density_kg_m3=0 -o out/light");
  bench.good("report out/light --to light.pdf");
  check_refused("report out/small --to out/small/report.pdf", bench.at,
                Contains("choose a folder outside it"));
  check_refused("report out/small --to report.txt", bench.at,
                Contains("expected a name that ends in .pdf"));
  // before the studies, which take long
  check_refused("report out/small --to small.toml/report.pdf", bench.at,
                Contains("is no folder in which files can be made"));
  check_refused("report out/none", bench.at, Contains("out/none"));
}

TEST_CASE("modes writes a table, shapes and a picture of every mode", "[standard]") {
  const Bench bench(small + "[rod]\ndensity_kg_m3 = 6450.0\n");
  const auto said = bench.good("modes small.toml --count 3");
  CHECK_THAT(said.out, Catch::Contains("Hz"));
  const auto folder = bench.at / "out/small_modes";
  CHECK(files_in(folder) == listed({"modes.csv", "preset.toml", "shapes.csv", "small.png",
                                    "small_1.png", "small_2.png", "small_3.png", "summary.json"}));
  CHECK_THAT(text_of(folder / "modes.csv"),
             Catch::StartsWith("mode,frequency_Hz,error_Hz,residual\n1,"));
  CHECK_THAT(text_of(folder / "shapes.csv"), Catch::StartsWith("mode,i,j,dx,dy,dz\n1,"));
  bench.good("modes small.toml --count 1 --movies");
  CHECK(files_in(folder / "mode_01/frames").size() == 24);
  check_refused("modes small.toml --set rod.density_kg_m3=0", bench.at,
                Catch::Contains("[rod] density_kg_m3"));
}

TEST_CASE("where the window's program is missing it is said how to build it") {
  const TemporaryFolder folder;
  const fs::path alone = folder.path() / "gridshell";
  fs::copy_file(GRIDSHELL_PROGRAM, alone);
  const Ended ended = Running("view", folder.path(), alone.c_str()).wait();
  CHECK(ended.code == 1);
  CHECK_THAT(ended.err, Contains((folder.path() / "gridshell_window").string()) &&
                            Contains("app/run.sh view"));
}
