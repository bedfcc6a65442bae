#include <catch2/catch.hpp>
#include <cmath>

#include "engine/footprint/footprint.h"
#include "tests/results.h"

using namespace gridshell;

TEST_CASE("footprint: the circle of Fig. 1") {
  const Footprint net = circular_footprint(126.0, 12, 20.0, Placement::half).value();
  CHECK(net.rods.size() == 24);
  CHECK(net.joints.size() == 120);
  CHECK(net.cells.size() == 97);
  // the longest leg on the circle's axis: R_o/d - (n-1)/2 = 0.8 there would be a rod through the
  // middle; with half placement the legs are cut exactly where the circle meets the rods
  for (const FootprintRod& rod : net.rods) {
    CHECK(std::hypot(rod.span.end, rod.line()) == Approx(126.0).epsilon(1e-15));
    CHECK(rod.span.begin == -rod.span.end);
    for (std::size_t k = 1; k < rod.joints.size(); ++k) {
      const auto& a = net.joints[rod.joints[k - 1]];
      const auto& b = net.joints[rod.joints[k]];
      CHECK(std::hypot(b.u - a.u, b.v - a.v) == Approx(20.0).epsilon(1e-14));
    }
  }
  for (const FootprintJoint& joint : net.joints) {
    CHECK(joint.u == (joint.i + 0.5) * 20.0);
    CHECK(joint.v == (joint.j + 0.5) * 20.0);
    CHECK(std::hypot(joint.u, joint.v) < 126.0);
  }
  for (const FootprintCell& cell : net.cells) {
    const auto& corner = net.joints[cell.joints[0]];
    CHECK((corner.i == cell.i && corner.j == cell.j));
    const auto& opposite = net.joints[cell.joints[2]];
    CHECK((opposite.i == cell.i + 1 && opposite.j == cell.j + 1));
  }
  CHECK(net.shortest_leg() == Approx(std::sqrt(126.0 * 126.0 - 50.0 * 50.0) - 110.0));
}

TEST_CASE("footprint: legs may be longer than a cell, corners may be cut off") {
  const Footprint dome = circular_footprint(20.0 * (5.5 + 3.1), 12, 20.0, Placement::half).value();
  CHECK(dome.rods.size() == 24);
  CHECK(dome.joints.size() == 144);
  CHECK(dome.cells.size() == 121);
  CHECK(dome.longest_leg() > 20.0);
  const Footprint odd = circular_footprint(105.0, 11, 20.0, Placement::on_axis).value();
  CHECK(odd.rods.size() == 22);
  CHECK(odd.longest_leg() == Approx(std::sqrt(105.0 * 105.0 - 40.0 * 40.0) - 80.0));
}

TEST_CASE("footprint: what makes no sense is refused with its reason") {
  const auto message = [](double radius, int rods, double spacing, Placement placement) {
    return refusal(circular_footprint(radius, rods, spacing, placement));
  };
  CHECK(message(126, 1, 20, Placement::on_axis) ==
        "1 rod a direction makes no cell: take at least 2");
  CHECK(message(126, 11, 20, Placement::half) ==
        "11 rods a direction do not fit placement \"half\": rods at (i + 1/2) d (\"half\") are an "
        "even number, rods at i d (\"on_axis\") an odd one");
  CHECK(
      message(100, 12, 20, Placement::half) ==
      "12 rods a direction at d = 20 mm reach 110 mm, beyond the boundary: the longest leg R_o/d - "
      "(n-1)/2 = -0.5 must be above 0; take R_o >= 110.02 mm or n <= 10");
  // the outermost rods of each family lie beyond the reach of all others
  CHECK(
      message(50.5, 6, 20, Placement::half) ==
      "the u-rod at v = -50 mm crosses no other rod: it would hang on its two ends alone; move the "
      "boundary or the spacing");
  CHECK(refusal(cut_footprint(Disk(1e6), 1.0, Placement::half)) != "none");
}

TEST_CASE("footprint: grid lines that cross no other within the boundary are left out") {
  // the lines at 10 and 30 mm cross, those at 50 mm end before them
  const auto net = value_of(cut_footprint(Disk(50.5), 20, Placement::half));
  CHECK(net.rods.size() == 8);
  CHECK(net.lone_lines == 4);
  CHECK(net.joints.size() == 16);
  for (const FootprintRod& rod : net.rods) CHECK(rod.joints.size() >= 2);
  CHECK(cut_footprint(Disk(51.5), 20, Placement::half)->lone_lines == 0);
  CHECK(refusal(cut_footprint(Disk(9), 20, Placement::on_axis)) == "none");
  CHECK(refusal(cut_footprint(Disk(11), 20, Placement::half)) ==
        "no two rods of spacing 20 mm cross within the boundary: it must be larger, or the spacing "
        "smaller");
}
