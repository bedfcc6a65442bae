// Footprints from networks of rods: what points become, and networks that are not connected or not
// supported.
#include "engine/footprint/network.h"

#include <cmath>

#include "engine/footprint/mesh.h"
#include "engine/geometry/closed_curve.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

/// A network of rods through numbered points, some of which are supported or free.
RodNetwork network(const std::vector<Eigen::Vector2d>& points,
                   const std::vector<std::vector<int>>& rods,
                   const std::vector<int>& supported = {}, const std::vector<int>& free = {}) {
  RodNetwork net;
  net.points.setZero(3, Eigen::Index(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k)
    net.points.col(Eigen::Index(k)).head<2>() = points[k];
  net.rods = rods;
  net.supported.assign(points.size(), 0);
  net.free.assign(points.size(), 0);
  for (const int point : supported) net.supported[std::size_t(point)] = 1;
  for (const int point : free) net.free[std::size_t(point)] = 1;
  return net;
}

/// three rods through one point, and their ends
const std::vector<Eigen::Vector2d> star{{0, 0},   {10, 0}, {-10, 0}, {6, 8},
                                        {-6, -8}, {-6, 8}, {6, -8}};
const std::vector<std::vector<int>> through{{1, 0, 2}, {3, 0, 4}, {5, 0, 6}};

void refused(const RodNetwork& net, const std::string& reason) {
  CHECK_THAT(refusal(network_footprint(net)), Catch::Contains(reason));
}

}  // namespace

TEST_CASE("three rods through one joint") {
  const auto made = value_of(network_footprint(network(star, through, {}, {1})));
  const Footprint& net = made.footprint;
  CHECK(net.joints.size() == 1);
  CHECK(net.cells.empty());
  CHECK(net.rods[0].begin == RodEnd::free);
  CHECK(net.rods[0].end == RodEnd::pinned);
  CHECK(net.spacing == Approx(10));
  CHECK(made.ends == std::vector<int>{1, 2, 3, 4, 5, 6});
  const RodMesh mesh = mesh_rods(net, 4);
  CHECK(mesh.nodes() == 1 + 6 + 3 * 2 * 3);
  for (std::size_t r = 0; r < 3; ++r) CHECK(mesh.rods[r][4] == 0);
  CHECK((mesh.flat.col(mesh.rods[1][2]) - Eigen::Vector2d(3, 4)).norm() < 1e-12);
}

TEST_CASE("a rod that ends on another is joined there, ends alone at a free point to one another") {
  // a T, its stem ending inside the bar, and a foot that continues the stem by a hinge
  const auto made =
      value_of(network_footprint(network({{-10, 0}, {0, 0}, {10, 0}, {0, -10}, {5, -20}, {-5, -20}},
                                         {{0, 1, 2}, {1, 3}, {3, 4}, {3, 5}}, {}, {3})));
  const Footprint& net = made.footprint;
  CHECK(net.joints.size() == 2);
  CHECK(net.rods[1].begin == RodEnd::joined);
  CHECK(net.rods[1].end == RodEnd::joined);
  CHECK(net.rods[2].begin == RodEnd::joined);
  CHECK(net.rods[2].end == RodEnd::pinned);
  const RodMesh mesh = mesh_rods(net, 2);
  CHECK(mesh.rods[1].front() == 0);
  CHECK(mesh.rods[1].back() == 1);
  CHECK(mesh.flat.col(mesh.rods[1][1]).isApprox(Eigen::Vector2d(0, -5)));
}

TEST_CASE("a closed chain of rods whose ends meet is a frame where its joints are named") {
  // four rods around a square, fixed at one corner and on springs at two
  const std::vector<Eigen::Vector2d> square{{0, -7}, {7, 0}, {0, 7}, {-7, 0}};
  RodNetwork net = network(square, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {0, 1, 2});
  net.springs = {{1, {0, 0, 9}}, {2, {9, 0, 9}}};
  refused(net,
          "rods[3]: is joined to no other rod: where rods only end, as at point 3, each is fixed");
  refused(net, "{\"point\": 3, \"to_mm\": \"free\"}");
  net.joined = {0, 1, 2, 3};
  const auto made = value_of(network_footprint(net));
  CHECK(made.footprint.joints.size() == 4);
  CHECK(made.footprint.fixed_joints.size() == 3);
  for (const FootprintRod& rod : made.footprint.rods) {
    CHECK(rod.begin == RodEnd::joined);
    CHECK(rod.end == RodEnd::joined);
  }
}

TEST_CASE("a ring comes back to its first joint and a polyline is as long as its pieces") {
  const std::vector<Eigen::Vector2d> square{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  const auto made = value_of(network_footprint(network(square, {{0, 1, 2, 3, 0}}, {1, 2, 3})));
  const FootprintRod& ring = made.footprint.rods.front();
  CHECK(ring.closed());
  CHECK(ring.span.end == Approx(8));
  CHECK(ring.at(3).isApprox(Eigen::Vector2d(-1, 0)));
  CHECK(ring.tangent(3).isApprox(Eigen::Vector2d(0, -1)));
  CHECK(made.footprint.joints.size() == 4);
  CHECK(made.footprint.fixed_joints == std::vector<int>{1, 2, 3});
  const RodMesh mesh = mesh_rods(made.footprint, 4);
  CHECK(mesh.rods[0].front() == mesh.rods[0].back());
  CHECK(mesh.rods[0].size() == 17);
}

TEST_CASE("a network that is a square grid is named as one, in whichever direction its rods run") {
  // 3 x 2 lines at 10 mm about the origin, rods crosswise and backwards
  std::vector<Eigen::Vector2d> points;
  std::vector<std::vector<int>> rods;
  const auto point = [&](double x, double y) {
    points.emplace_back(x, y);
    return int(points.size()) - 1;
  };
  int joint[4][2];
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 2; ++j) joint[i][j] = point(10 * (i - 1.5), 10 * (j - 0.5));
  for (int i = 0; i < 4; ++i)
    rods.push_back(
        {point(10 * (i - 1.5), 12), joint[i][1], joint[i][0], point(10 * (i - 1.5), -12)});
  for (int j = 0; j < 2; ++j)
    rods.push_back({point(-22, 10 * (j - 0.5)), joint[0][j], joint[1][j], joint[2][j], joint[3][j],
                    point(22, 10 * (j - 0.5))});
  const auto made = value_of(network_footprint(network(points, rods)));
  const Footprint& net = made.footprint;
  CHECK(net.cells.size() == 3);
  CHECK(net.rods[0].family == Family::u);
  CHECK(net.rods[0].index == -1);
  std::vector<int> numbers;
  for (const FootprintRod& rod : made.footprint.rods) numbers.push_back(rod.number);
  CHECK(numbers == std::vector<int>{4, 5, 0, 1, 2, 3});
  CHECK(net.rods[2].family == Family::v);
  CHECK(net.rods[2].span.begin == -12);
  CHECK(made.ends[4] == rods[0].back());
  CHECK(net.spacing == 10);
  // a joint keeps the name of its point
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 2; ++j) {
      const FootprintJoint& at = net.joints[std::size_t(2 * i + j)];
      CHECK(std::pair(at.i, at.j) == std::pair(joint[i][j], 0));
      CHECK(at.u == Approx(10 * (i - 1.5)));
    }
  // a rod that ends on another is of no grid
  rods[5] = {rods[5][0], rods[5][1], rods[5][2]};
  const auto cut = value_of(network_footprint(network(points, rods)));
  CHECK(cut.footprint.cells.empty());
  CHECK(cut.footprint.rods[0].family == Family::other);
}

TEST_CASE("supports on springs: of an end, of ends that meet, of a joint inside a rod") {
  // a cross whose arm to the right ends with that of a third rod
  RodNetwork net = network({{-10, 0}, {0, 0}, {10, 0}, {0, -10}, {0, 10}, {10, 10}},
                           {{0, 1, 2}, {3, 1, 4}, {2, 5}}, {0, 1, 2});
  net.springs = {{0, {1, 2, 3}}, {1, {4, 5, 0}}, {2, {6, 0, 7}}};
  const auto made = value_of(network_footprint(net));
  const Footprint& footprint = made.footprint;
  CHECK(footprint.rods[0].begin == RodEnd::sprung);
  CHECK(footprint.rods[0].end == RodEnd::joined);
  CHECK(footprint.rods[2].begin == RodEnd::joined);
  CHECK(footprint.rods[2].end == RodEnd::pinned);
  CHECK(footprint.fixed_joints == std::vector<int>{0, 1});
  REQUIRE(footprint.springs.size() == 3);
  CHECK(footprint.springs[0].end == 0);
  CHECK(footprint.springs[0].N_per_mm == Eigen::Vector3d(1, 2, 3));
  CHECK(footprint.springs[1].joint == 0);
  CHECK(footprint.springs[2].joint == 1);
  CHECK(footprint.springs[2].N_per_mm == Eigen::Vector3d(6, 0, 7));
  CHECK(footprint.is_sprung(1));
  const RodMesh mesh = mesh_rods(footprint, 2);
  REQUIRE(mesh.springs.size() == 3);
  CHECK(mesh.springs[0].node == mesh.joints);
  CHECK(mesh.springs[2].node == 1);
  CHECK(mesh.springs[2].support == mesh.nodes() - 1);
  CHECK(mesh.flat.col(mesh.springs[2].support) == Eigen::Vector2d(10, 0));
}

TEST_CASE("springs along too few directions leave a network free") {
  RodNetwork net = network(star, through, {1, 2, 3, 4, 5, 6});
  const auto on = [&](const Eigen::Vector3d& k) {
    for (int point = 1; point < 7; ++point) net.springs[point] = k;
  };
  const std::string free = "rods[0] and what is joined to it: supported by springs along too few";
  on({0, 1, 1});
  refused(net, free);
  on({1, 1, 0});
  refused(net, free);
  // three points on springs along z and three on springs in the plane leave nothing free
  net.springs[1] = net.springs[2] = net.springs[3] = {0, 0, 1};
  CHECK(network_footprint(net));
  on({0, 0, 1});
  refused(net, free);
  // fixed at one point and on springs along z, it still rotates about that point
  net.springs.erase(1);
  refused(net, free);
  net.springs[3] = {1, 0, 1};
  CHECK(network_footprint(net));
}

TEST_CASE("networks that do not make a shell are refused") {
  refused(network(star, {{1, 0, 2}, {3, 3, 0, 4}}), "rods[1]: got point 3 twice in turn");
  refused(network(star, {{1, 0, 2}, {3}}), "rods[1]: got one point");
  refused(network(star, {{1, 0, 2}, {1, 0, 3}}),
          "rods[1]: got a rod from point 0 to 1, as rods[0] is");
  refused(network(star, {{1, 0, 2}, {3, 0, 4, 5, 0, 6}}),
          "rods[1]: got a rod that passes a point twice");
  refused(network(star, {{1, 0, 1}}), "rods[0]");
  refused(network(star, {{1, 2}, {3, 4}}), "rods[0]: got a rod without a joint");
  refused(network(star, {{1, 0, 2}, {3, 0, 4}, {5, 6}}), "rods[2]: got a rod without a joint");
  refused(network(star, {{1, 0, 2}, {3, 0, 4}}, {5}), "point 5 is a support, and no rod has it");
  refused(network(star, {{1, 0, 2}, {3, 0, 4}}, {}, {0}), "point 0 is free, and inside a rod");
  refused(network(star, {{1, 0, 2}, {3, 0, 4}}, {1}, {1}), "point 1 is a support and free");
  refused(network(star, {{1, 0, 2}, {3, 0, 4}}, {}, {3, 4}), "fewer than three points");
  // a single straight rod may rotate about its own line, but not swing: a spring along x alone does
  // not prevent that
  RodNetwork rope = network({{0, 0}, {9, 0}, {18, 0}}, {{0, 1, 2}});
  CHECK(network_footprint(rope));
  rope.springs[2] = {1, 0, 0};
  refused(rope, "at points on one line");
  refused(rope, "{\"point\": 1, \"spring_N_per_mm\": [0, 0.001, 0]}");
  // a second piece, fixed on one line
  refused(network({{0, 0}, {9, 0}, {-9, 0}, {0, 9}, {0, -9}, {50, 0}, {60, 0}, {55, 0}, {55, 5}},
                  {{1, 0, 2}, {3, 0, 4}, {5, 7, 6}, {7, 8}}, {}, {8}),
          "rods[2] and what is joined to it");
}

TEST_CASE("rods in space are as long as their polyline there, and laid where they are drawn") {
  RodNetwork net = network({{-3, 0}, {0, 0}, {3, 0}, {0, -8}, {0, 8}}, {{0, 1, 2}, {3, 1, 4}});
  net.points.row(2) << 0, 4, 0, 0, 4;
  const auto made = value_of(network_footprint(net));
  const Footprint& drawn = made.footprint;
  CHECK(drawn.in_space());
  CHECK(drawn.cells.empty());
  CHECK(drawn.rods[0].family == Family::other);  // no square grid, though it looks so from above
  CHECK(drawn.rods[0].span.end == Approx(10));
  CHECK(drawn.rods[1].span.end == Approx(std::sqrt(80) + 8));
  const RodMesh mesh = mesh_rods(drawn, 4);
  const Eigen::Matrix3Xd nodes = drawn_nodes(mesh, {});
  CHECK((nodes.col(0) - Eigen::Vector3d(0, 0, 4)).norm() < 1e-12);
  CHECK((nodes.col(mesh.joints) - Eigen::Vector3d(-3, 0, 0)).norm() < 1e-12);
  // each edge is as long as the rod between its positions
  for (std::size_t r = 0; r < mesh.rods.size(); ++r)
    for (std::size_t k = 1; k < mesh.rods[r].size(); ++k)
      CHECK((nodes.col(mesh.rods[r][k]) - nodes.col(mesh.rods[r][k - 1])).norm() ==
            Approx(mesh.position[r][k] - mesh.position[r][k - 1]).epsilon(1e-12));
  // a level network counts as plane at any height
  net.points.row(2).setZero();
  CHECK_FALSE(network_footprint(net)->footprint.in_space());
  // supported at points of one vertical plane it is stable, on one line it is not
  RodNetwork upright = network({{-3, 0}, {0, 0}, {3, 0}, {0, 0}, {0, 0}}, {{0, 1, 2}, {3, 1, 4}});
  upright.points.row(2) << 0, 0, 0, -5, 5;
  CHECK(network_footprint(upright));
  upright.points.row(2) << -3, 0, 3, -5, 5;
  upright.points.row(0) << -3, 0, 3, -5, 5;
  refused(upright, "at points on one line");
}

TEST_CASE("the rim of points has those on the edges of their hull, each position once") {
  Eigen::Matrix2Xd points(2, 7);
  points << 0, 1, 1, 0, 0.5, 0.5, 0.5, 0, 0, 1, 1, 0.5, 0, 0;
  CHECK(rim_of(points) == std::vector<int>{0, 5, 1, 2, 3});
}

TEST_CASE("the convex hull goes round once") {
  Eigen::Matrix2Xd points(2, 6);
  points << 0, 1, 1, 0, 0.5, 0.5, 0, 0, 1, 1, 0.5, 0;
  CHECK(hull_of(points) == std::vector<int>{0, 1, 2, 3});
}
