#include "engine/record/contacts.h"

#include <cmath>
#include <numbers>
#include <random>

#include "engine/core/proximity.h"
#include "engine/simulate/frames.h"
#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::record;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Two families of `rods` rods, `edges` edges between joints and a leg of a segment at each end.
struct Grid {
  Layout layout;
  Eigen::Matrix2Xd flat;

  Grid(int rods, int edges) {
    preset::NetworkData file;
    file.rods.resize(2 * std::size_t(rods));
    for (int i = -1; i <= rods; ++i)
      for (int j = -1; j <= rods; ++j) {
        const auto point = int(file.points.size());
        file.points.push_back({20.0 * i, 20.0 * j, 0});
        if (j >= 0 && j < rods) file.rods[std::size_t(j)].push_back(point);
        if (i >= 0 && i < rods) file.rods[std::size_t(rods + i)].push_back(point);
      }
    const Scene scene = value_of(scene_of(network(std::move(file))));
    const RodMesh mesh = mesh_rods(scene.footprint, edges);
    layout = value_of(simulate::layout_of(scene, mesh));
    layout.rod_diameter_mm = 0.254;
    layout.joint_diameter_mm = 3;
    layout.joint_height_mm = 5;
    // from the first joint, not from the middle
    flat = mesh.flat.colwise() - mesh.flat.col(mesh.rods[0][std::size_t(edges)]);
  }

  /// Straight rods that cross at an angle.
  Eigen::Matrix3Xd sheared(double angle) const {
    Eigen::Matrix3Xd x(3, flat.cols());
    x.row(0) = flat.row(0) + std::cos(angle) * flat.row(1);
    x.row(1) = std::sin(angle) * flat.row(1);
    x.row(2).setZero();
    return x;
  }
};

Layout lone_rod(int points) {
  Layout layout;
  layout.rod_diameter_mm = 1;
  layout.rods.resize(1);
  for (int k = 0; k < points; ++k) layout.rods[0].push_back(k);
  return layout;
}

int count_of(const Contacts& found, ContactKind kind) {
  return int(std::ranges::count(found.interpenetrations, kind, &Contact::kind));
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

TEST_CASE("nearest points of segments: no others are nearer") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> draw(-1, 1);
  const auto point = [&] { return Eigen::Vector3d(draw(random), draw(random), draw(random)); };
  for (int trial = 0; trial < 300; ++trial) {
    const Eigen::Vector3d p = point(), q = point(), a = point();
    // some parallel, some crossing, some points
    const Eigen::Vector3d b = trial % 5 == 0   ? Eigen::Vector3d(a + 0.7 * (q - p))
                              : trial % 5 == 1 ? Eigen::Vector3d(p + q - a)
                              : trial % 5 == 2 ? a
                                               : point();
    const NearestPoints near = nearest_points(p, q, a, b);
    const auto distance2 = [&](double s, double t) {
      return (p + s * (q - p) - a - t * (b - a)).squaredNorm();
    };
    CHECK(near.distance2 == Approx(distance2(near.s, near.t)).margin(1e-15));
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j <= 20; ++j) CHECK(near.distance2 <= distance2(i / 20.0, j / 20.0) + 1e-12);
  }
}

TEST_CASE("contacts are those that every pair of edges has, in 200 random states") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> draw(0, 1);
  const Grid grid(4, 8);
  Layout layout = grid.layout;
  layout.table_mm = -2;
  const ContactSearch round(layout);
  for (std::size_t rod = 0; rod < layout.rods.size(); ++rod)
    layout.laths_mm.insert(layout.laths_mm.end(), {0.2, 0.6});
  const ContactSearch laths(layout);
  int rods = 0, joints = 0, table = 0, itself = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::Matrix3Xd x = grid.sheared((2 + 60 * draw(random) * draw(random)) * degree);
    // waves, in every second state a fold, in every fourth noise
    const double size = 6 * draw(random), fold = 0.06 * draw(random);
    const Eigen::Array3d way(draw(random), draw(random), draw(random));
    for (long k = 0; k < x.cols(); ++k) {
      const Eigen::Vector2d uv = grid.flat.col(k);
      x.col(k).array() += size * (0.2 * uv.x() + 0.31 * uv.y() + 6 * way).sin();
      const double height = x(0, k);
      if (trial % 2)
        x(0, k) = std::sin(fold * height) / fold, x(2, k) += 10 * std::cos(fold * height);
      if (trial % 4 == 3)
        for (int c = 0; c < 3; ++c) x(c, k) += 1.5 * draw(random);
    }
    const ContactSearch& search = trial % 5 == 0 ? laths : round;
    const Contacts found = search.in(x), all = search.by_all_pairs(x);
    INFO("state " << trial);
    REQUIRE(found.interpenetrations.size() == all.interpenetrations.size());
    CHECK(same(found.rod_gap_mm, all.rod_gap_mm));
    CHECK(same(found.joint_gap_mm, all.joint_gap_mm));
    for (std::size_t k = 0; k < all.interpenetrations.size(); ++k) {
      CHECK(found.interpenetrations[k].first == all.interpenetrations[k].first);
      CHECK(found.interpenetrations[k].second == all.interpenetrations[k].second);
      CHECK(found.interpenetrations[k].gap_mm == all.interpenetrations[k].gap_mm);
      CHECK(all.interpenetrations[k].gap_mm < 0);
      itself += all.interpenetrations[k].first == all.interpenetrations[k].second;
    }
    rods += count_of(all, ContactKind::rods);
    joints += count_of(all, ContactKind::joints);
    table += count_of(all, ContactKind::table);
  }
  CHECK(rods > 500);
  CHECK(joints > 100);
  CHECK(table > 100);
  CHECK(itself > 20);
}

TEST_CASE("straight rods that cross are not reported at any angle, joints of a closed cell are") {
  for (const int edges : {2, 8, 32}) {
    const Grid grid(3, edges);
    const ContactSearch search(grid.layout);
    for (double angle = 6; angle <= 174; angle += 4) {
      INFO(edges << " edges, " << angle << " degrees");
      const Contacts found = search.in(grid.sheared(angle * degree));
      CHECK(count_of(found, ContactKind::rods) == 0);
      // the short diagonal of a cell
      const double diagonal =
          40 * std::min(std::sin(angle * degree / 2), std::cos(angle * degree / 2));
      CHECK(count_of(found, ContactKind::joints) == (diagonal < 3 ? 4 : 0));
      if (diagonal < 6)
        CHECK(found.joint_gap_mm == Approx(diagonal - 3));
      else
        CHECK(std::isnan(found.joint_gap_mm));
    }
  }
}

TEST_CASE("rods of a cell that bend onto each other touch, on any mesh at the same positions") {
  for (const int edges : {8, 16, 32}) {
    const Grid grid(2, edges);
    Eigen::Matrix3Xd x = grid.sheared(10 * degree);
    // the middle of a u rod's segment touches the adjacent v rod, 10 mm from the joint (0, 0)
    const auto& u = grid.layout.rods[0];
    for (const int node : u)
      if (grid.flat(0, node) > 0 && grid.flat(0, node) < 20)
        x(1, node) += 1.75 * std::pow(std::sin(grid.flat(0, node) * std::numbers::pi / 20), 6);
    const Contacts found = ContactSearch(grid.layout).in(x);
    INFO(edges << " edges");
    REQUIRE(count_of(found, ContactKind::rods) == 1);
    CHECK(found.interpenetrations[0].first == 0);
    CHECK(found.interpenetrations[0].second == 2);
    CHECK(found.rod_gap_mm < -0.1);
    CHECK(found.interpenetrations[0].at.head<2>().norm() == Approx(10).margin(1.5));
  }
}

TEST_CASE("laths on edge side by side touch by their widths, not as round rods do") {
  Grid grid(2, 8);
  grid.layout.joint_diameter_mm = 1;
  const Eigen::Matrix3Xd x = grid.sheared(8 * degree);  // 2.78 mm between parallel rods
  const auto places = [&](double width, double thickness) {
    grid.layout.laths_mm.clear();
    for (std::size_t rod = 0; rod < grid.layout.rods.size(); ++rod)
      grid.layout.laths_mm.insert(grid.layout.laths_mm.end(), {width, thickness});
    const ContactSearch search(grid.layout);
    CHECK(search.in(x).interpenetrations.size() == search.by_all_pairs(x).interpenetrations.size());
    return search.in(x).interpenetrations.size();
  };
  CHECK(places(1, 6) == 0);
  CHECK(places(6, 1) > 0);
  grid.layout.laths_mm.clear();
  grid.layout.rod_diameter_mm = std::sqrt(4 * 6 / std::numbers::pi);  // of their area
  CHECK(ContactSearch(grid.layout).in(x).interpenetrations.size() > 0);
}

TEST_CASE("rods that are fixed at one point of the boundary are near there, and cross after it") {
  Layout layout = lone_rod(6);
  layout.rods.push_back({6, 7, 8, 9, 10, 11});
  layout.joint_diameter_mm = 3;
  const auto found = [&](const Eigen::Vector3d& begin, const Eigen::Vector3d& way) {
    Eigen::Matrix3Xd x(3, 12);
    for (int k = 0; k < 6; ++k) {
      x.col(k) << 5 * k, 0, 0;
      x.col(6 + k) = begin + 5 * k * way.normalized();
    }
    return ContactSearch(layout).in(x).interpenetrations;
  };
  for (const double degrees : {8, 30, 90, 170})
    CHECK(found({0, 0, 0.1}, {std::cos(degrees * degree), std::sin(degrees * degree), 0}).empty());
  CHECK(found({0, 0, 0.1}, {1, 0.05, 0}).size() == 1);
  CHECK(found({-3, -3, 0}, {1, 1, 0}).size() == 1);
}

TEST_CASE("a rod touches itself where a loop closes, not where it only bends") {
  constexpr int points = 200;
  Eigen::Matrix3Xd x(3, points);
  // a helix of a rod of 1 mm, whose windings are at a distance of one pitch
  const auto helix = [&](double radius, double pitch) {
    for (int k = 0; k < points; ++k) {
      const double turn = 4 * std::numbers::pi * k / points;
      x.col(k) << radius * std::cos(turn), radius * std::sin(turn),
          pitch * turn / (2 * std::numbers::pi);
    }
  };
  const ContactSearch search(lone_rod(points));
  helix(5, 0.9);
  const Contacts touching = search.in(x);
  REQUIRE(touching.interpenetrations.size() == 1);
  CHECK(touching.interpenetrations[0].first == touching.interpenetrations[0].second);
  CHECK(touching.rod_gap_mm == Approx(-0.1).margin(0.01));
  helix(5, 1.2);
  CHECK(search.in(x).interpenetrations.empty());
  CHECK(search.in(x).rod_gap_mm == Approx(0.2).margin(0.01));
  helix(0.7, 8);  // as tight as it may be
  CHECK(search.in(x).interpenetrations.empty());
  // a ring closes at its joint
  Layout ring = lone_rod(points);
  ring.rods[0].push_back(0);
  ring.joints = {{0, 0, 0, 0, 0}};
  for (int k = 0; k < points; ++k)
    x.col(k) << 5 * std::cos(2 * std::numbers::pi * k / points),
        5 * std::sin(2 * std::numbers::pi * k / points), 0;
  CHECK(ContactSearch(ring).in(x).interpenetrations.empty());
}

TEST_CASE("neighbours along a rod do not touch where its points are closer than its thickness") {
  // every point is a joint, as the points of a polyline are
  constexpr int points = 300;
  Layout layout = lone_rod(points);
  layout.joint_diameter_mm = 3;
  layout.joint_height_mm = 5;
  for (int k = 0; k < points; ++k) layout.joints.push_back({k, 0, 0, 0, k});
  Eigen::Matrix3Xd x(3, points);
  // an arch of radius 40, its points at distances of 0.4 mm on a rod of 1 mm
  for (int k = 0; k < points; ++k) {
    const double angle = 0.01 * k;
    x.col(k) << 40 * std::cos(angle), 40 * std::sin(angle), 0;
  }
  CHECK(ContactSearch(layout).in(x).interpenetrations.empty());
  CHECK(ContactSearch(layout).by_all_pairs(x).interpenetrations.empty());
  // windings of a helix do touch
  for (int k = 0; k < points; ++k) {
    const double angle = 4 * std::numbers::pi * k / points;
    x.col(k) << 5 * std::cos(angle), 5 * std::sin(angle), 0.9 * angle / (2 * std::numbers::pi);
  }
  const Contacts helix = ContactSearch(layout).in(x);
  CHECK_FALSE(helix.interpenetrations.empty());
  CHECK(helix.rod_gap_mm == Approx(-0.1).margin(0.01));
  CHECK(std::ranges::all_of(helix.interpenetrations,
                            [](const Contact& at) { return at.kind == ContactKind::rods; }));
  // for a ring also across the point at which it starts
  Layout ring = layout;
  ring.rods[0].push_back(0);
  for (int k = 0; k < points; ++k) {
    const double angle = 2 * std::numbers::pi * k / points;
    x.col(k) << 20 * std::cos(angle), 20 * std::sin(angle), 0;
  }
  CHECK(ContactSearch(ring).in(x).interpenetrations.empty());
  CHECK(ContactSearch(ring).by_all_pairs(x).interpenetrations.empty());
}

TEST_CASE("a table is touched more than a radius below its plane, where there is one") {
  Grid grid(2, 4);
  Eigen::Matrix3Xd x = grid.sheared(90 * degree);
  x.row(2).setConstant(-0.12);
  grid.layout.table_mm = 0;
  CHECK(ContactSearch(grid.layout).in(x).interpenetrations.empty());
  x(2, grid.layout.rods[1][2]) = -1;
  const Contacts found = ContactSearch(grid.layout).in(x);
  REQUIRE(found.interpenetrations.size() == 1);
  CHECK(found.interpenetrations[0].kind == ContactKind::table);
  CHECK(found.interpenetrations[0].first == 1);
  CHECK(found.interpenetrations[0].gap_mm == Approx(0.127 - 1));
  grid.layout.table_mm = unknown;
  CHECK(ContactSearch(grid.layout).in(x).interpenetrations.empty());
}
