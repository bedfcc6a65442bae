// Joints that a file of a network lists: what becomes one, its position, and what is refused.
#include "engine/formats/network_file.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

// two rods that cross 1 mm from one another's points, and one that ends near the first
const std::string beside = R"({
  "points_mm": [[-10, 0], [0.6, 0], [10, 0], [0, -10], [0, 0.8], [0, 10], [10, 0.2], [20, 5]],
  "rods": [
    [0, 1, 2],
    [3, 4, 5],
    [6, 7]
  ],
  "joints": [
    [4, 1],
    [2, 6]
  ],
  "supports": [{"point": [0, -10]}, {"point": 5, "to_mm": [0, 9, 0]}]
})";

std::string with(const std::string& from, const std::string& to) {
  auto text = beside;
  return text.replace(text.find(from), from.size(), to);
}

NetworkData read(const std::string& text) { return value_of(read_network(text, "n.json")); }

void wrong(const std::string& joints, const std::string& reason) {
  CHECK_THAT(refusal(read_network(with("[4, 1],\n    [2, 6]", joints), "n.json")),
             Catch::StartsWith("n.json:9: joints[0]: ") && Catch::Contains(reason));
}

}  // namespace

TEST_CASE("points of a listed joint are one, at their mean position") {
  const NetworkData network = read(beside);
  CHECK(network.rods == std::vector<std::vector<int>>{{0, 4, 2}, {3, 4, 5}, {2, 7}});
  CHECK(network.points[4] == std::vector<double>{0.3, 0.4, 0});
  CHECK(network.points[2] == std::vector<double>{10, 0.1, 0});
  CHECK(network.points[0] == std::vector<double>{-10, 0, 0});
  // where rods only end a joint is a hinge, and a support where the file says so
  CHECK(network.free == std::vector<int>{2});
  const NetworkData held = read(with("{\"point\": 5", "{\"point\": 6}, {\"point\": 5"));
  CHECK(held.free.empty());
  CHECK(held.supports == Points{{3}, {2}, {5, 0, 9, 0}});
}

TEST_CASE("a listed joint of three rods, and one that closes a ring") {
  const std::string star = R"({
    "points_mm": [[0.3, 0], [0, 0.3], [0, 0]],
    "rods": [[[-9, 0], 0, [9, 0]], [[0, -9], 1, [0, 9]], [2, [9, 9]]],
    "joints": [[0, 1, [0, 0]]]})";
  const NetworkData three = read(star);
  CHECK(three.rods == std::vector<std::vector<int>>{{3, 0, 4}, {5, 0, 6}, {0, 7}});
  CHECK(three.points[0][0] == Approx(0.1));
  CHECK(three.points[0][1] == Approx(0.1));
  CHECK(three.free.empty());

  const std::string open = R"({
    "rods": [[[-9, 0], [0, 9], [9, 0], [0, -9], [-9, -0.5]]],
    "joints": [[[-9, 0], [-9, -0.5]]]})";
  const NetworkData ring = read(open);
  CHECK(ring.rods == std::vector<std::vector<int>>{{0, 1, 2, 3, 0}});
  CHECK(ring.points[0] == std::vector<double>{-9, -0.25, 0});
  CHECK(ring.free.empty());
}

TEST_CASE("joints that cannot be are refused, with their line") {
  wrong("\"x\"", "expected a list of 2 to 100 points");
  wrong("[4]", "expected a list of 2 to 100 points");
  wrong("[4, 8]", "got point 8, expected 0 to 7");
  wrong("[4, -1]", "got point -1, expected 0 to 7");
  wrong("[4, \"1\"]", "expected the number of a point");
  wrong("[4, 4]", "got a point twice");
  wrong("[1, 2]", "rods[0] has both point 1 and point 2");
  wrong("[0, 2]", "rods[0] has both point 0 and point 2");
  wrong("[1, [3, 3]]", "got point 8, which no rod has");
  wrong("[1, 5]",
        "got point 1 at 5.009 mm from the middle of the joint's points, expected at most 2.3 mm");
  // the second joint has the point already
  const auto twice = read_network(with("[4, 1]", "[4, 1, 6]"), "n.json");
  REQUIRE_FALSE(twice);
  CHECK_THAT(twice.error().message,
             Catch::Contains("n.json:10: joints[1]: point 6 is of another joint too"));
  const auto held = read_network(
      with("{\"point\": 5", "{\"point\": 2}, {\"point\": 6}, {\"point\": 5"), "n.json");
  REQUIRE_FALSE(held);
  CHECK(held.error().message.find("got point 2 as a support twice") != std::string::npos);
}

TEST_CASE("joints of a network have laws of their own, by point or by points that become one") {
  const NetworkData network =
      read(with("[4, 1],\n    [2, 6]", R"({"points": [4, 1], "law": "hinge"},
    {"points": [2, 6], "law": "spring", "shear_Nmm": 3.5, "twist_Nmm": 2})"));
  CHECK(network.rods[0] == std::vector<int>{0, 4, 2});
  CHECK(network.joint_laws == Points{{4, 0, -1}, {2, 3.5, 2}});
  CHECK(network_error(network).empty());
  wrong(R"({"points": [4, 1], "law": "stiff"})", "expected \"law\" of");
  wrong(R"({"points": [4, 1], "law": "hinge", "shear_Nmm": 1})", "expected {\"point\"");
  wrong(R"({"points": [4, 1], "law": "spring", "shear_Nmm": -1})", "_Nmm: got ");
  wrong(R"({"law": "rigid"})", "got a law of no joint");
  wrong(R"({"point": 99, "law": "rigid"})", "got a point that is not in points_mm");
}

TEST_CASE("a network's law is that of all joints which have none of their own") {
  const auto lawful = [](const std::string& law) {
    return R"({"points_mm": [[-10, 0], [0, 0], [10, 0], [0, -10], [0, 10]],
      "rods": [[0, 1, 2], [3, 1, 4]], "law": )" +
           law + "}";
  };
  CHECK(read(lawful(R"("hinge")")).joint_laws == Points{{every_joint, 0, -1}});
  CHECK(read(lawful(R"({"law": "spring", "twist_Nmm": 2})")).joint_laws ==
        Points{{every_joint, 0, 2}});
  NetworkData network = read(lawful(R"("rigid")"));
  CHECK(network_error(network).empty());
  network.joint_laws.front().push_back(5);
  CHECK_THAT(network_error(network), Catch::Contains("eccentricity_mm in the row of all others"));
  CHECK_THAT(refusal(read_network(lawful(R"({"law": "rigid", "point": 1})"), "n.json")),
             Catch::Contains("law: got the law of all joints"));
  CHECK_THAT(refusal(read_network(lawful("3"), "n.json")), Catch::Contains("expected \"law\" of"));
}
