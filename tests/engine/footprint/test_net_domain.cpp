#include <catch2/catch.hpp>
#include <cmath>

#include "engine/footprint/domains.h"

using namespace gridshell;

TEST_CASE("cap domain: rods of the published hemisphere, on its axes") {
  const double radius = 120 / M_PI_2;  // 76.394 mm
  CHECK(radius == Approx(76.394).margin(5e-4));
  const SphereNet net(radius);
  const auto hemisphere = cap_of(net, 0).value();
  const double half_lengths[] = {120.0, 116.0, 104.9, 89.0, 69.7, 46.8};
  const double ends[][2] = {{0.0, 76.4},  {19.3, 73.9}, {35.0, 67.9},
                            {46.9, 60.3}, {56.3, 51.6}, {65.4, 39.4}};
  for (int k = 0; k < 6; ++k) {
    // the rod u = 20 k runs along v
    const double u = 20 * k;
    const auto pieces = hemisphere->intervals(Family::v, u);
    REQUIRE(pieces.size() == 1);
    CHECK(pieces[0].begin == -pieces[0].end);
    CHECK(std::abs(pieces[0].end - half_lengths[k]) <= 0.05);
    const Eigen::Vector3d end = net.at(u, pieces[0].end)->position;
    CHECK(std::abs(end.x() - ends[k][0]) <= 0.05);
    CHECK(std::abs(end.y() - ends[k][1]) <= 0.05);
    CHECK(std::abs(end.z()) < 1e-12);
  }
  CHECK(hemisphere->intervals(Family::u, 120.1).empty());
  CHECK(hemisphere->reach() == Approx(120));
}

TEST_CASE("cap domain: contours and smallest shear angles of the caps") {
  const SphereNet net(1);
  const double table[][4] = {{0, 1.570796, 0.980507, 37.575},   {0.3, 1.266104, 0.815285, 52.823},
                             {0.5, 1.047198, 0.690070, 63.054}, {0.7, 0.795399, 0.537725, 73.510},
                             {0.8, 0.643501, 0.441154, 78.873}, {0.9, 0.451027, 0.313850, 84.359}};
  for (const auto& [height, axis, diagonal, angle] : table) {
    const auto cap = cap_of(net, height).value();
    const double on_axis = cap->intervals(Family::u, 0)[0].end;
    CHECK(std::abs(on_axis - axis) <= 0.6e-6);
    CHECK(std::abs(on_axis - std::acos(height)) < 1e-15);
    const Eigen::Matrix2Xd ring = cap->boundary(360);
    CHECK(std::abs(ring(0, 45) - diagonal) <= 0.6e-6);
    CHECK(std::abs(ring(0, 45) - ring(1, 45)) < 1e-15);
    double smallest = M_PI, off_plane = 0, off_circle = 0;
    for (const auto& uv : ring.colwise()) {
      const NetPoint p = net.at(uv[0], uv[1]).value();
      smallest = std::min(smallest, p.omega);
      off_plane = std::max(off_plane, std::abs(p.position.z() - height));
      off_circle = std::max(off_circle,
                            std::abs(p.position.head<2>().norm() - std::sqrt(1 - height * height)));
    }
    CHECK(std::abs(smallest * 180 / M_PI - angle) <= 0.6e-3);
    CHECK(off_plane < 1e-14);
    CHECK(off_circle < 1e-14);
  }
}

TEST_CASE("cap domain: grid lines end on the plane, to 1e-14, also short ones") {
  const double radius = 120;
  const SphereNet net(radius);
  for (const double height : {0.0, 0.28, 0.9, 0.999}) {
    const auto cap = cap_of(net, height).value();
    for (const double part : {0.0, 0.3, 0.7, 0.95, 0.999, 0.999999}) {
      const double v = part * cap->reach();
      const auto pieces = cap->intervals(Family::u, v);
      REQUIRE(pieces.size() == 1);
      CHECK(std::abs(net.at(pieces[0].end, v)->position.z() / radius - height) < 1e-14);
      // the middle is inside
      CHECK(net.at(0, v)->position.z() > height * radius);
    }
  }
  CHECK(cap_of(net, 1).error().message ==
        "the cap's cut height is 1 of the radius, it must lie in [0, 1)");
  CHECK_FALSE(cap_of(net, -0.1));
  CHECK_FALSE(cap_of(net, std::nan("")));
}

TEST_CASE("half of a surface of revolution: long edges in z = 0, rings at the ends") {
  for (const auto& profile : {cylinder_profile(40, 75).value(), spool_profile(100, 0.5).value()}) {
    const RevolutionNet net =
        RevolutionNet::make(profile, RevolutionNet::right_angled(profile)).value();
    const double length = 150;
    const auto half = half_of(net, length).value();
    for (const Family family : {Family::u, Family::v}) {
      for (double c = -0.99 * half->reach(); c < half->reach(); c += 7.3) {
        const auto pieces = half->intervals(family, c);
        REQUIRE(pieces.size() == 1);
        for (const double at : {pieces[0].begin, pieces[0].end}) {
          const auto p = family == Family::u ? net.at(at, c) : net.at(c, at);
          REQUIRE(p);
          const bool on_base = std::abs(p->position.z()) < 1e-11;
          const bool on_ring = std::abs(std::abs(p->position.x()) - length / 2) < 1e-11;
          CHECK((on_base || on_ring));
          CHECK(p->position.z() > -1e-11);
          CHECK(std::abs(p->position.x()) < length / 2 + 1e-11);
        }
      }
      CHECK(half->intervals(family, 1.001 * half->reach()).empty());
    }
    const Eigen::Matrix2Xd ring = half->boundary(100);
    REQUIRE(ring.cols() == 100);
    int corners = 0;
    for (const auto& uv : ring.colwise()) {
      const NetPoint p = net.at(uv[0], uv[1]).value();
      const bool on_base = std::abs(p.position.z()) < 1e-11;
      const bool on_ring = std::abs(std::abs(p.position.x()) - length / 2) < 1e-11;
      CHECK((on_base || on_ring));
      corners += on_base && on_ring;
    }
    CHECK(corners == 4);
  }
}

TEST_CASE("half of a surface of revolution: too long says where the net ends") {
  const Profile spool = spool_profile(100, 0.5).value();
  const RevolutionNet net = RevolutionNet::make(spool, RevolutionNet::right_angled(spool)).value();
  const auto half = half_of(net, 1000);
  REQUIRE_FALSE(half);
  CHECK(half.error().message.find("folds (shear angle 180 degrees) where u + v = -18") !=
        std::string::npos);
  CHECK(half.error().message.find("-500 mm lies beyond") != std::string::npos);
  CHECK_FALSE(half_of(net, 0));
}
