// [[step]]: read, refused with file, line and key, and written as it reads.
#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

const std::string two_steps = R"(
[[step]]
do = "push"
joint = [1, -2]
to_mm = [10.5, -3.0, 40.25]
along = [0.0, 0.0, 1.0]
[[step]]
do = "move"
progress = 0.5
edge_points = [[3, 1.5, -1e-17, 0.0]]
)";

}  // namespace

TEST_CASE("steps are read in their order, each with defaults of its own") {
  const auto presets = good(two_steps);
  const auto& steps = presets.base.step;
  REQUIRE(steps.size() == 2);
  CHECK(steps[0].kind == StepKind::push);
  CHECK(steps[0].joint == std::vector{1, -2});
  CHECK(steps[0].to_mm == std::vector{10.5, -3.0, 40.25});
  CHECK(steps[1].progress == 0.5);
  CHECK(steps[1].joint.empty());
  CHECK(steps[1].edge_points == Points{{3, 1.5, -1e-17, 0}});
}

TEST_CASE("written steps read back to the bit, without the keys that they do not use") {
  const auto presets = good(two_steps);
  const std::string text = to_toml(presets);
  CHECK_THAT(text, Catch::Contains("[[step]]\ndo = \"move\"\nprogress = 0.5\nedge_points = ") &&
                       !Catch::Contains("factor"));
  const auto again = good(text);
  CHECK(to_toml(again) == text);
}

TEST_CASE("an override names an item of a list of tables by its number") {
  const auto read = [](const std::string& set) {
    return read_preset_text(two_steps, "good.toml", "good", {parse_override(set).value()});
  };
  const auto moved = read("step.2.progress=0.25");
  REQUIRE(moved);
  CHECK(moved->base.step[1].progress == 0.25);
  CHECK(moved->base.step[0].progress == 1);
  for (const auto& [set, reason] :
       {std::pair("step.3.progress=0.5",
                  "step.3.progress: got 2 [[step]], expected the number of one"),
        {"step.progress=0.5", "expected the number of one, as step.1."},
        {"step.2=1", "[[step]] 2 : unknown key"},
        {"step.2.progress=-1", "--set: [[step]] 2 progress: got -1 "},
        {"loads.case.1.snow=2",
         "loads.case.1.snow: got 0 [[loads.case]], expected the number of one"}}) {
    CHECK_THAT(refusal(read(set)), Catch::Contains(reason));
  }
}

TEST_CASE("load cases are in [loads], are written there and read back") {
  const std::string text = R"(
[loads]
snow_N_m2 = 750.0
[[loads.case]]
name = "half"
snow = 1.5
snow_side = "-x"
[[step]]
do = "load"
case = "half"
[[case]]
name = "light"
loads.snow_N_m2 = 100.0
[[case.loads.case]]
name = "half"
snow = 1.0
)";
  const auto presets = good(text);
  const Preset& base = presets.base;
  REQUIRE(base.load_case.size() == 1);
  CHECK(base.load_case[0].name == "half");
  CHECK(base.load_case[0].snow == 1.5);
  CHECK(base.load_case[0].snow_side == SnowSide::minus_x);
  CHECK(base.step[0].load_case == "half");
  const Preset& light = presets.cases[0].preset;
  CHECK(light.loads.snow_N_m2 == 100);
  CHECK(light.load_case[0].snow == 1);
  CHECK(light.load_case[0].snow_side == SnowSide::all);
  const std::string written = to_toml(presets);
  const auto again = good(written);
  CHECK(to_toml(again) == written);
}

TEST_CASE(
    "what is wrong with a step is said with its position, its number and what would be right") {
  using Row = std::pair<std::string, std::string>;
  const auto [text, sentence] = GENERATE(values<Row>({
      {"[[step]]\ndo = \"shove\"",
       "bad.toml:2:6: [[step]] 1 do: got \"shove\" (unknown name), expected \"move\", \"push\", "
       "\"hold\", \"release\", \"load\", \"rest\", \"jitter\", \"tighten\", \"brace\" or \"open\""},
      {"[[step]]\ndo = \"open\"",
       "bad.toml:1:1: [[step]] 1 angle_deg: got 0.0 (both or none of angle_deg and angles), "
       "expected one of them"},
      {"[[step]]\ndo = \"open\"\nangles = [[0.5, 0, 80]]",
       "bad.toml:3:10: [[step]] 1 angles: got [[0.5, 0.0, 80.0]] ([0.5, 0] is no joint), expected "
       "integers"},
      {"[[step]]\ndo = \"open\"\nangles = [[0, 0, 400]]",
       "bad.toml:3:10: [[step]] 1 angles: got [[0.0, 0.0, 400.0]] (an angle of 400 degrees), "
       "expected 1 to 179"},
      {"[[step]]\ndo = \"move\"\nedge_points = [[1, 0, 0, 1], [1, 0, 0, 2]]",
       "bad.toml:3:15: [[step]] 1 edge_points: got [[1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 2.0]] "
       "([1] twice), expected each edge point once"},
      {"[[step]]\ndo = \"brace\"",
       "bad.toml:1:1: [[step]] 1 EA_N: got 0.0 (a brace needs a stiffness), expected above 0"},
      {"[[step]]\ndo = \"load\"\ncase = \"snow\"",
       "bad.toml:3:8: [[step]] 1 case: got \"snow\" (no such case), expected the name of a "
       "[[loads.case]]"},
      {"[[loads.case]]\nname = \"snow\"\nsnow = 1.0",
       "bad.toml:3:8: [[loads.case]] 1 snow: got 1.0 (there is no snow), expected [loads] "
       "snow_N_m2 above 0"},
      {"[[loads.case]]\nname = \"rim\"\nedge = 1.0",
       "bad.toml:3:8: [[loads.case]] 1 edge: got 1.0 (there is no load on the edge), expected "
       "[loads] edge_N_m above 0"},
      {"[[step]]\ndo = \"rest\"\n[[step]]\ndo = \"hold\"",
       "bad.toml:3:1: [[step]] 2 joint: got [], expected [i, j]"},
      {"[[step]]\ndo = \"push\"\njoint = [0, 0]",
       "bad.toml:1:1: [[step]] 1 depth_mm: got 0.0 (both or none of to_mm and depth_mm), expected "
       "one of them"},
      {"[[step]]\ndo = \"rest\"\nfactor = 2.0",
       "bad.toml:3:10: [[step]] 1 factor = 2.0 has no effect, leave it out: [[step]] 1 do = "
       "\"rest\" does not use it, only \"load\""},
      {"[[step]]\ndo = \"move\"\nradius_mm = 200.0",
       "bad.toml:3:13: [[step]] 1 radius_mm: got 200.0 (larger than the footprint), expected at "
       "most R_o = 126"},
      {"[indentation]\ndepth = 0.1\n[[step]]\ndo = \"rest\"",
       "bad.toml:4:6: [[step]] 1 do: got \"rest\" ([indentation] pushes already), expected a step "
       "\"push\" instead of it"},
      {"[step]\ndo = \"rest\"", "bad.toml:1:2: step: expected tables, each [[step]]"},
  }));
  CHECK(errors_of(text) == sentence);
}
