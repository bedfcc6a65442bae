// Folders that `run --resume` may not write.
#include "app/cli/staged_folder.h"

#include "tests/app/bench.h"
#include "tests/results.h"

using namespace gridshell;

TEST_CASE("a run that cannot replace the folder is not resumed, and what it has stays") {
  const Bench bench(small_preset({}));
  bench.good("movie small.toml -o out/small");
  const fs::path left = bench.at / "out/small.partial-7";
  fs::create_directories(left);
  REQUIRE(write_file(left / "found.txt", "a path"));
  const auto resumed = app::StagedFolder::resume(bench.at / "out/small", "run", left);
  REQUIRE_FALSE(resumed);
  CHECK(resumed.error().fault == Fault::bad_input);
  CHECK_THAT(resumed.error().message, Contains("made by 'gridshell movie'"));
  CHECK(text_of(left / "found.txt") == "a path");
  CHECK(app::StagedFolder::resume(bench.at / "out/small", "movie", left));
}
