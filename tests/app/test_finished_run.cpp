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
}
