// Shells of building blocks, from a preset to a certified state.
#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

preset::Preset read(const std::string& text) { return preset::good(text).base; }

const std::string two_quarters = R"(
[footprint]
kind = "blocks"
placement = "on_axis"
[[block]]
name = "a"
radius_mm = 120.0
east = 0
[[block]]
name = "b"
radius_mm = 120.0
west = 0
[[join]]
first = "a.east"
second = "b.west"
[actuation]
start = "net"
)";

}  // namespace

TEST_CASE("two quarter-spheres relax to the hemisphere") {
  const auto joined = run_stills(read(two_quarters)).summary;
  const auto whole = run_stills(on_net());
  const double scale = run_stills(read(two_quarters)).trajectory.layout.length_scale_mm;
  CHECK(joined.stable);
  CHECK(joined.joints == whole.summary.joints);
  CHECK(joined.max_deviation * scale == Approx(whole.summary.max_deviation * 120).margin(1e-3));
  CHECK(joined.total_K == Approx(whole.summary.total_K).margin(1e-5));
  CHECK(joined.max_seam_gap_mm < 1e-9);
  CHECK(joined.max_seam_kink_deg < 1e-6);
}

TEST_CASE("a cylinder between quarter-spheres: certified, near its blocks, all of it recorded",
          "[standard]") {
  const std::string text = R"(
[blocks]
max_gap_mm = 7.0
[[block]]
name = "middle"
kind = "cylinder"
radius_mm = 120.0
crossing_deg = 104.0
length_mm = 300.0
west = -4
east = 4
[[join]]
first = "b.east"
second = "middle.west"
)";
  // a closed end, a cylinder, and no end: its cut side is not joined
  auto open = two_quarters;
  open.replace(open.find("second = \"b.west\""), 17, "second = \"middle.west\"");
  CHECK_THAT(refused_run(read(open + text.substr(0, text.find("[[join]]")))),
             Catch::Contains("is cut and not joined"));

  auto stadium = read(open + text.substr(0, text.find("[[join]]")) +
                      "[[join]]\nfirst = \"middle.east\"\nsecond = \"b.west\"\n");
  const auto outcome = run_stills(stadium);
  const auto& layout = outcome.trajectory.layout;
  CHECK(outcome.summary.stable);
  CHECK(outcome.summary.limit == record::Limit::none);
  CHECK(outcome.summary.max_deviation * layout.length_scale_mm < 12);
  CHECK(outcome.summary.max_seam_gap_mm == Approx(6.3).margin(0.1));
  CHECK(layout.parts.size() == 3);
  CHECK(layout.seam_rods.size() == 2 * 22);
  for (const record::Part& part : layout.parts) CHECK(part.net.allFinite());

  // from flat it reaches the same state
  stadium.actuation.start = preset::Start::flat;
  const auto flat = run_to_end(stadium, true);
  CHECK(distance(flat, outcome) < 1e-3);
}
