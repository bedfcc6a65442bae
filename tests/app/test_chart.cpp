// `gridshell chart`: requests that make no chart.
#include "tests/app/bench.h"

TEST_CASE("a list of sizes without a number is refused") {
  const Bench bench(small_preset({}));
  check_refused("chart accuracy small.toml --sizes , -o chart", bench.at,
                Contains("--sizes ,: expected at least one number of rods"));
  CHECK_FALSE(fs::exists(bench.at / "chart"));
}
