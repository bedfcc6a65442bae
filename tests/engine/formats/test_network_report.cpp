// The report on a network's file: counts of what was read, and notes.
#include "engine/formats/network_file.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

FileReport report_of(const std::string& bytes, const std::string& name) {
  FileReport report;
  value_of(read_network(bytes, name, {}, &report));
  return report;
}

}  // namespace

TEST_CASE("a report counts rods, joints, supports and free ends, and says how large it is") {
  const auto report = report_of(R"({"points_mm": [[-10, 0], [10, 0], [0, -10], [0, 10, 4], [0, 0]],
    "rods": [[0, 4, 1], [2, 4, 3], [1, 3]],
    "supports": [{"point": 0}, {"point": 2, "to_mm": "free"}],
    "joints": [{"point": 3, "law": "hinge"}]})",
                                "n.json");
  CHECK(report.text ==
        "n.json: 3 rods, 2 joints, 2 supports, 1 free end, 20 x 20 x 4 mm; at 1 support rods end "
        "together and are fixed");
  CHECK(report.notes.empty());
  const auto upright = report_of("v 0 0 0\nv 9 0 9\nv 0 0 9\nv 9 0 0\nl 1 2\nl 3 4\n", "n.obj");
  CHECK_THAT(upright.text, Catch::StartsWith("n.obj: in mm, as OBJ names no unit"));
  REQUIRE(upright.notes.size() == 1);
  CHECK_THAT(upright.notes[0], Catch::Contains("Then exchange y and z"));
}

TEST_CASE("the spacing of a network is the median distance of joints along its rods") {
  const auto network = value_of(read_network(
      "v -30 0 0\nv 30 0 0\nv -10 -9 0\nv -10 9 0\nv 10 -9 0\nv 10 9 0\nl 1 2\nl 3 4\nl 5 6\n",
      "n.obj"));
  CHECK(spacing_of(network) == 9);
}
