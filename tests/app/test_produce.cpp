#include "app/cli/produce.h"

#include "engine/core/json.h"
#include "tests/app/bench.h"

namespace {

const std::string pushed = small_preset({.rods = 6, .radius_mm = 70, .actuated_mm = 60}) +
                           "[indentation]\nat = \"pole\"\ndepth_mm = 2\n";

}  // namespace

TEST_CASE("the joint that is pushed is named, and how far it is from the middle") {
  const Bench bench(pushed);
  // half a spacing of 20 mm from either axis
  CHECK_THAT(bench.good("run small.toml").out,
             Contains("pushed at joint [-1, -1], 14.1 mm from the middle of the footprint"));
  const auto summary = gridshell::parsed(text_of(bench.at / "out/small/summary.json"));
  CHECK(summary["pushed_joint"] == "[-1, -1]");
}

TEST_CASE("rods above their strength break in plain words, others are within it") {
  const Bench bench(small_preset({}));
  CHECK_THAT(bench.good("run small.toml --set rod.strength_MPa=10").out,
             Contains("  BREAKS: ") && Contains(" times the strength, in ") &&
                 Contains("; the largest stress is "));
  CHECK_THAT(
      bench.good("run small.toml --set rod.strength_MPa=1e5").out,
      Contains("  stress at most 0.0") && Contains("of the strength, in ") && !Contains("BREAKS"));
}
