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

/// What the program says of a file; "none" where nothing.
std::string told(const std::string& text) {
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
  CHECK(told(whole) == "none");
  const Damage all[] = {
      {"[20, 0]", "[20, NaN]", "n.json:2: is no JSON here"},
      {"[20, 0]", "[20, 1e400]", "n.json:2: "},
      {"[20, 0]", "[20]", "n.json:2: points_mm[2]: a point of 1 coordinates, must be [x, y]"},
      {"\"joints\"", "\"rods\"",
       "n.json:9: key 'rods' stands twice in one object, must stand once"},
      {"\"point\": 5", "\"point\": 4, \"point\": 5", "key 'point' stands twice"},
      {"[6, 2, 7]", "[6, 2, 8]", "n.json:7: rods[2]: point 8, must be from 0 to 7"},
      {"[6, 2, 7]", "[6, 2, 7.0]", "n.json:7: rods[2]: a point must be its number, or its place"},
      {"[6, 2, 7]", "[[6, 2, 7, 1]]", "rods[2]: a point of 4 coordinates"},
      {"[6, 2, 7]", "[3, 2, 7]", "rods[2]: runs from point 2 to 3, as rods[0] does"},
      {"[6, 2, 7]", "[6, 2, 7], [[0, 90], [50, 90]]", "rods[3]: is joined to no other rod"},
      {"0.3", "true", "n.json:6: rods[1]: must be {\"points\": list"},
      {"0.3", "1e9", "rods[1]: a diameter of 1e+09 mm, must be from 1e-6 to 1e6"},
      {"0.3", "90", "rods[1]: a diameter of 90 mm, must be less than the usual distance"},
      {"\"diameter_mm\"", "\"young_GPa\": true, \"diameter_mm\"",
       "n.json:6: rods[1]: must be {\"points\": list"},
      {"\"diameter_mm\"", "\"diam_mm\"", "rods[1]: unknown key 'diam_mm'"},
      {"\"clamped\"", "\"clampd\"",
       "n.json:6: rods[1]: \"begin\" must be \"pinned\", \"tangent\", \"clamped\""},
      {"\"begin\"", "\"end\"", "rods[1]: its end hangs on a spring, how it is held"},
      {"\"hinge\"", "\"hing\"", "n.json:10: joints[0]: \"law\" must be \"free\", \"hinge\""},
      {"\"shear_Nmm\": 2", "\"shear_Nmm\": -2", "n.json:11: joints[1]: shear_Nmm and twist_Nmm"},
      {"\"point\": 2,", "\"point\": 1,", "the joint at point 1 has two laws, must have one"},
      {"\"point\": 1,", "\"point\": 6,", "no rods are joined at point 6"},
      {"[2, 2, 0]", "[2, -2, 0]", "n.json:15: supports[1]: a spring of -2 N/mm, must be 0 or from"},
      {"\"point\": 5", "\"point\": 0", "point 0 is named as a support twice, must be once"},
      {"\"point\": 7", "\"point\": 2", "point 2 is free, and inside a rod"},
      {"[-55, 0, 0]", "\"fre\"", "n.json:14: supports[0]: to_mm must be [x, y, z], or \"free\""}};
  for (const Damage& one : all) {
    std::string text = whole;
    const auto at = text.find(one.from);
    REQUIRE(at != text.npos);
    text.replace(at, std::string(one.from).size(), one.to);
    CAPTURE(one.from, one.to);
    CHECK_THAT(told(text), Catch::Contains(one.answer));
  }
  // cut short anywhere
  for (std::size_t size = 0; size < whole.size(); size += 7)
    CHECK_THAT(told(whole.substr(0, size)), Catch::Contains("JSON"));
}
