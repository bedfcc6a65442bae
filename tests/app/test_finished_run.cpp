// Pictures of a finished run, made from within its folder.
#include "tests/app/bench.h"

TEST_CASE("the turntable of the current folder is next to it, and the run can be drawn again") {
  const Bench bench(small_preset({}));
  bench.good("run small.toml -o run");
  const fs::path run = bench.at / "run";
  const Arguments turntable = "movie . --turntable --frames 2 --quiet";
  good(turntable, run);
  CHECK(files_under(bench.at / "run_turntable/frames", ".png").size() == 2);
  CHECK(files_under(run, ".png").empty());
  // a folder in the run would keep it from being drawn
  check_refused("movie . --turntable --frames 2 -o inside", run,
                Contains("'inside' is in the run folder"));
  bench.good("render run --quiet");
  CHECK(files_under(run / "frames", ".png").size() == 3);
}

TEST_CASE("the report of the current folder is next to it", "[standard]") {
  const Bench bench(small_preset({}));
  bench.good("run small.toml -o run");
  good("report .", bench.at / "run");
  CHECK(fs::exists(bench.at / "run_report.pdf"));
  // the loads of a run that was stopped would be those of another shell
  const fs::path summary = bench.at / "run/summary.json";
  std::string text = text_of(summary);
  text.replace(text.find("\"finished\": true"), 16, "\"finished\": false");
  REQUIRE(write_file(summary, text));
  check_refused("report run", bench.at, Contains("'run' is not finished"));
}

TEST_CASE("a file may be next to a run, by any path, and in a folder with a manifest of its own") {
  const Bench bench(small_preset({}));
  bench.good("run small.toml -o run");
  REQUIRE(write_file(bench.at / "manifest.txt", "a list of mine\n"));
  bench.good("export run --to run/../beside.obj");
  CHECK(fs::exists(bench.at / "beside.obj"));
  fs::create_directory_symlink(bench.at / "run", bench.at / "link");
  check_refused("export run --to link/inside.obj", bench.at, Contains("is in the run folder"));
}

TEST_CASE("a movie whose pictures were deleted can be made again in its folder") {
  const Bench bench(small_preset({}));
  bench.good("movie small.toml --frames 2 -o movie --quiet");
  for (const fs::path& picture : files_under(bench.at / "movie/frames", ".png"))
    fs::remove(picture);
  bench.good("movie small.toml --frames 2 -o movie --quiet");
  CHECK(files_under(bench.at / "movie/frames", ".png").size() == 2);
}
