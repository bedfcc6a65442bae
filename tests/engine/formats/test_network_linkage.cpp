// Linkages stored as one line per segment, which are joined to rods by their directions.
#include <numbers>

#include "engine/formats/network_file.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

struct Read {
  NetworkData network;
  FileReport report;
};

Read read(const std::string& obj) {
  Read read;
  read.network = value_of(read_network(obj, "x.obj", {.linkage = true}, &read.report));
  return read;
}

std::string vertex(double x, double y, double z = 0) {
  return fmt::format("v {} {} {}\n", x, y, z);
}

/// Rhombi of n x m segments, whose sides cross at `degrees` and turn by `bend` degrees from one to
/// the next; a line per segment, in either direction.
std::string rhombi(int n, int m, double degrees, double bend = 0) {
  const double half = 0.5 * degrees * std::numbers::pi / 180;
  std::string text;
  const auto at = [&](double p, double q) {
    const double turn = bend * (p + q) * std::numbers::pi / 180;
    return Eigen::Vector2d(
        Eigen::Rotation2Dd(turn) *
        Eigen::Vector2d(100 + 10 * (p + q) * std::cos(half), 10 * (p - q) * std::sin(half)));
  };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) text += vertex(at(i, j).x(), at(i, j).y());
  const auto number = [&](int i, int j) { return (m + 1) * i + j + 1; };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) {
      if (i < n) text += fmt::format("l {} {}\n", number(i + 1, j), number(i, j));
      if (j < m) text += fmt::format("l {} {}\n", number(i, j), number(i, j + 1));
    }
  return text;
}

}  // namespace

TEST_CASE("a linkage's segments are rods by their direction, all joints of which open together") {
  for (const double degrees : {4.0, 30.0, 80.0, 150.0})
    for (const double bend : {0.0, 0.5}) {
      CAPTURE(degrees, bend);
      const auto [network, report] = read(rhombi(3, 4, degrees, bend));
      CHECK(network.rods.size() == 9);
      std::size_t points = 0;
      for (const auto& rod : network.rods) points += rod.size();
      CHECK(points == 2 * 20);
      CHECK(network.joint_laws == Points{{every_joint, 0, -1}});
      const OpeningSense sense = opening_sense(network);
      CHECK(std::ranges::count(sense.family, 0) * std::ranges::count(sense.family, 1) == 20);
      CHECK(sense.against.empty());
      CHECK(mean_angle(network) <= 0.5 * std::numbers::pi);
      CHECK_THAT(report.text,
                 Catch::Contains("31 segments: rods by direction cross at 6 joints and "
                                 "end at 14 more (0 free ends)"));
      CHECK(report.notes.empty());
      // a reversed rod closes its joints while the others open
      NetworkData other = network;
      std::ranges::reverse(other.rods.back());
      CHECK(opening_sense(other).against.size() == other.rods.back().size());
    }
}

TEST_CASE("drawings read the same lines otherwise: ends in line are one rod, others supports") {
  const auto drawn = value_of(read_network(rhombi(3, 4, 30, 2), "x.obj"));
  CHECK(drawn.joint_laws.empty());
  CHECK(drawn.free.empty());
}

TEST_CASE("three springs prevent rigid motions alone, in the plane and in space") {
  for (const bool upright : {false, true}) {
    std::string text = rhombi(2, 3, 40);
    if (upright) {
      std::string turned;
      for (const auto& point : read(text).network.points)
        turned += vertex(point[2], point[0], point[1]);
      text = turned + text.substr(text.find("l "));
    }
    const NetworkData network = read(text).network;
    REQUIRE(network.springs.size() == 3);
    // six independent motions (e, p x e)
    Eigen::Matrix<double, 6, 6> held = Eigen::Matrix<double, 6, 6>::Zero();
    int row = 0;
    for (const auto& spring : network.springs)
      for (int axis = 0; axis < 3; ++axis) {
        if (spring[std::size_t(axis) + 1] == 0) continue;
        REQUIRE(row < 6);
        const Eigen::Vector3d e = Eigen::Vector3d::Unit(axis),
                              p = position_of(network, int(spring[0])) / 50;
        held.row(row++) << e.transpose(), p.cross(e).transpose();
      }
    CHECK(row == 6);
    CHECK(std::abs(held.determinant()) > 1e-3);
    for (const auto& support : network.supports)
      CHECK(std::ranges::count(network.free, int(support[0])) == 0);
  }
}

TEST_CASE("of three segments the straightest two that make no triangle are one rod") {
  // one rod 3 - 1 - 4, the straightest, would close a triangle with the rods 3 - 5 and 4 - 5
  const std::string text = vertex(0, 0) + vertex(40, 2) + vertex(-20, 5) + vertex(20, -8) +
                           vertex(0, -20) + "l 1 2\nl 1 3\nl 1 4\nl 3 5\nl 4 5\n";
  const NetworkData network = read(text).network;
  for (const auto& rod : network.rods)
    CHECK_FALSE((std::ranges::count(rod, 2) > 0 && std::ranges::count(rod, 0) > 0 &&
                 std::ranges::count(rod, 3) > 0));
  CHECK(network.rods.size() == 4);
}

TEST_CASE("what is no linkage is refused with the line") {
  const auto refused = [](const std::string& obj, const std::string& name = "x.obj") {
    return refusal(read_network(obj, name, {.linkage = true}));
  };
  std::string star = vertex(0, 0);
  for (int k = 0; k < 5; ++k) star += vertex(10 * std::cos(k), 10 * std::sin(k));
  for (int k = 0; k < 5; ++k) star += fmt::format("l 1 {}\n", k + 2);
  CHECK(refused(star) == "x.obj:11: 5 segments meet at one point, expected at most 4 in a linkage");
  CHECK(refused(vertex(0, 0) + vertex(10, 0) + vertex(20, 1) + "l 1 2 3\n") ==
        "x.obj:4: a line through 3 points, expected 2: a linkage has a line per segment");
  CHECK_THAT(refused("{}", "x.json"), Catch::Contains("[footprint] linkage: got true"));
}
