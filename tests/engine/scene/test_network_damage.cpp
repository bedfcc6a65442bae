// Damaged files of networks: each message has the position and what would be valid.
#include "engine/formats/network_file.h"
#include "tests/presets.h"

using namespace gridshell;

namespace {

const std::string whole = R"({
  "points_mm": [[-60, 0], [-20, 0], [20, 0], [60, 0],
                [-20, -40], [-20, 40], [20, -40], [20, 40]],
  "rods": [
    [0, 1, 2, 3],
    {"points": [4, 1, 5], "diameter_mm": 0.3, "begin": "clamped"},
    [6, 2, 7]
  ],
  "joints": [
    {"point": 1, "law": "hinge"},
    {"point": 2, "law": "spring", "shear_Nmm": 2, "twist_Nmm": 3}
  ],
  "supports": [
    {"point": 0, "to_mm": [-55, 0, 0]},
    {"point": 5, "spring_N_per_mm": [2, 2, 0]},
    {"point": 7, "to_mm": "free"}
  ]
})";

/// The error that the program reports for a file, or "none".
std::string reported(const std::string& text) {
  const auto file = preset::read_network(text, "n.json");
  if (!file) return refusal(file);
  preset::Preset p = network(*file);
  p.rod.shear_GPa = 31;
  for (const auto& fault : preset::conflicts(p)) return fault.what;
  return refusal(scene_of(p));
}

struct Damage {
  const char *from, *to, *answer;
};

}  // namespace

TEST_CASE("damaged files of networks are answered by their position and what would be right") {
  CHECK(reported(whole) == "none");
  const Damage all[] = {
      {"[20, 0]", "[20, NaN]", "n.json:2: got no JSON"},
      {"[20, 0]", "[20, 1e400]", "n.json:2: "},
      {"[20, 0]", "[20]", "n.json:2: points_mm[2]: got a point of 1 coordinates, expected [x, y]"},
      {"\"joints\"", "\"rods\"", "n.json:9: got key 'rods' twice in one object, expected it once"},
      {"\"point\": 5", "\"point\": 4, \"point\": 5", "got key 'point' twice"},
      {"[6, 2, 7]", "[6, 2, 8]", "n.json:7: rods[2]: got point 8, expected 0 to 7"},
      {"[6, 2, 7]", "[6, 2, 7.0]", "n.json:7: rods[2]: got 7.0, expected the number of a point"},
      {"[6, 2, 7]", "[[6, 2, 7, 1]]", "rods[2]: got a point of 4 coordinates"},
      {"[6, 2, 7]", "[3, 2, 7]", "rods[2]: got a rod from point 2 to 3, as rods[0] is"},
      {"[6, 2, 7]", "[6, 2, 7], [[0, 90], [50, 90]]", "rods[3]: got a rod without a joint"},
      {"0.3", "true", "n.json:6: rods[1]: diameter_mm: got true, expected"},
      {"0.3", "1e9", "rods[1]: got a diameter of 1e+09 mm, expected 1e-6 to 1e6"},
      {"0.3", "90", "rods[1]: got a diameter of 90 mm, expected less than the usual distance"},
      {"\"diameter_mm\"", "\"young_GPa\": true, \"diameter_mm\"",
       "n.json:6: rods[1]: young_GPa: got true"},
      {"\"diameter_mm\"", "\"diam_mm\"", "rods[1]: got an unknown key 'diam_mm'"},
      {"\"clamped\"", "\"clampd\"",
       "n.json:6: rods[1]: begin: got \"clampd\", expected \"pinned\""},
      {"\"begin\"", "\"end\"", "rods[1]: its end is on a spring"},
      {"\"hinge\"", "\"hing\"", "n.json:10: joints[0]: got {"},
      {"\"shear_Nmm\": 2", "\"shear_Nmm\": -2", "n.json:11: joints[1]: shear_Nmm: got -2"},
      {"\"point\": 2,", "\"point\": 1,", "got two laws for the joint at point 1, expected one"},
      {"\"point\": 1,", "\"point\": 6,", "got point 6, where no rods are joined"},
      {"[2, 2, 0]", "[2, -2, 0]",
       "n.json:15: supports[1]: got a spring of -2 N/mm, expected 0 or from"},
      {"\"point\": 5", "\"point\": 0", "got point 0 as a support twice, expected once"},
      {"\"point\": 7", "\"point\": 2", "point 2 is free, and inside a rod"},
      {"[-55, 0, 0]", "\"fre\"",
       "n.json:14: supports[0]: to_mm: got \"fre\", expected [x, y, z], or \"free\""}};
  for (const Damage& one : all) {
    std::string text = whole;
    const auto at = text.find(one.from);
    REQUIRE(at != text.npos);
    text.replace(at, std::string(one.from).size(), one.to);
    CAPTURE(one.from, one.to);
    CHECK_THAT(reported(text), Catch::Contains(one.answer));
  }
  // cut short anywhere
  for (std::size_t size = 0; size < whole.size(); size += 7)
    CHECK_THAT(reported(whole.substr(0, size)), Catch::Contains("JSON"));
}
