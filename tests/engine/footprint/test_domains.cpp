// Where grid lines lie inside curves, caps and halves of surfaces; maps from boundary to boundary.
#include <cmath>

#include "engine/footprint/domains.h"
#include "tests/engine/geometry/net_checks.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

Eigen::Matrix2Xd points(std::initializer_list<Eigen::Vector2d> list) {
  Eigen::Matrix2Xd matrix(2, list.size());
  Eigen::Index k = 0;
  for (const Eigen::Vector2d& point : list) matrix.col(k++) = point;
  return matrix;
}

}  // namespace

TEST_CASE("curve domain: a circle cuts grid lines where a disk does") {
  const CurveDomain circle(ClosedCurve::ellipse(126, 126).value());
  const Disk disk(126);
  for (const double c : {-125.9999, -110.0, -10.0, 0.0, 10.0, 70.0, 125.9999}) {
    for (const Family family : {Family::u, Family::v}) {
      const auto pieces = circle.intervals(family, c);
      REQUIRE(pieces.size() == 1);
      CHECK(std::abs(pieces[0].begin - disk.intervals(family, c)[0].begin) < 1e-10);
      CHECK(std::abs(pieces[0].end - disk.intervals(family, c)[0].end) < 1e-10);
    }
  }
  CHECK(circle.intervals(Family::u, 126.01).empty());
  CHECK(circle.reach() == Approx(126).epsilon(2e-5));
  CHECK(circle.reach() >= 126);
  const Eigen::Matrix2Xd ring = circle.boundary(100);
  for (const auto& point : ring.colwise()) CHECK(point.norm() == Approx(126).epsilon(1e-14));
}

TEST_CASE("curve domain: an ellipse and a superellipse") {
  const CurveDomain ellipse(ClosedCurve::ellipse(100, 60).value());
  CHECK(ellipse.intervals(Family::u, 30)[0].end == Approx(100 * std::sqrt(0.75)).epsilon(1e-13));
  CHECK(ellipse.intervals(Family::v, 80)[0].end == Approx(36).epsilon(1e-13));
  const CurveDomain squarish(ClosedCurve::superellipse(100, 60, 4).value());
  CHECK(squarish.intervals(Family::u, 30)[0].end ==
        Approx(100 * std::pow(1 - std::pow(0.5, 4), 0.25)).epsilon(1e-13));
}

TEST_CASE("curve domain: a superellipse may be as large as a building, and its exponent too") {
  for (const double size : {1e-4, 1.0, 1e4}) {
    const ClosedCurve curve = value_of(ClosedCurve::superellipse(size, 0.8 * size, 100));
    CHECK(curve.at(0).position.isApprox(Eigen::Vector2d(size, 0)));
    CHECK(curve.at(M_PI_2).position.y() == Approx(0.8 * size));
    // nearly a rectangle
    CHECK(curve.length() == Approx(7.2 * size).epsilon(0.01));
    CHECK(curve.at(0.3).first.allFinite());
  }
}

TEST_CASE("curve domain: hollows cut a line more than once, edges on a line once") {
  // a U, open upwards, given clockwise and with its first point repeated
  const CurveDomain u(
      ClosedCurve::polygon(
          points(
              {{0, 0}, {0, 40}, {10, 40}, {10, 10}, {30, 10}, {30, 40}, {40, 40}, {40, 0}, {0, 0}}))
          .value());
  auto pieces = u.intervals(Family::u, 20);
  REQUIRE(pieces.size() == 2);
  CHECK((pieces[0].begin == Approx(0).margin(1e-14) && pieces[0].end == Approx(10)));
  CHECK((pieces[1].begin == Approx(30) && pieces[1].end == Approx(40)));
  CHECK(u.intervals(Family::u, 5).size() == 1);
  CHECK(u.intervals(Family::v, 20)[0].end == Approx(10));
  // along edges: always whole pieces
  for (const double c : {0.0, 10.0, 40.0})
    for (const auto& piece : u.intervals(Family::u, c)) CHECK(piece.end - piece.begin > 9.9);
  for (const double c : {0.0, 10.0, 30.0, 40.0})
    for (const auto& piece : u.intervals(Family::v, c)) CHECK(piece.end - piece.begin > 9.9);
  // all eight corners are in the polyline
  int corners = 0;
  const Eigen::Matrix2Xd ring = u.boundary(50);
  for (const auto& at : ring.colwise()) {
    const auto is = [](double a, std::initializer_list<double> of) {
      return std::any_of(of.begin(), of.end(), [a](double b) { return std::abs(a - b) < 1e-12; });
    };
    corners += is(at[0], {0, 10, 30, 40}) && is(at[1], {0, 10, 40});
  }
  CHECK(corners >= 8);
}

TEST_CASE("curve domain: a peanut of spline points has a waist") {
  Eigen::Matrix2Xd outline(2, 240);
  const auto radius = [](double angle) { return 60 + 30 * std::cos(2 * angle); };
  for (int k = 0; k < 240; ++k) {
    const double angle = 2 * M_PI * k / 240;
    outline.col(k) << radius(angle) * std::cos(angle), radius(angle) * std::sin(angle);
  }
  const CurveDomain peanut(ClosedCurve::spline(outline).value());
  CHECK(peanut.intervals(Family::v, 0)[0].end == Approx(30).epsilon(1e-6));
  CHECK(peanut.intervals(Family::u, 0)[0].end == Approx(90).epsilon(1e-6));
  const auto pieces = peanut.intervals(Family::u, 31);
  REQUIRE(pieces.size() == 2);
  CHECK(pieces[0].begin == Approx(-pieces[1].end).epsilon(1e-9));
  CHECK(pieces[1].begin > 1);
  for (const auto& piece : pieces)
    for (const double u : {piece.begin, piece.end}) {
      const double angle = std::atan2(31, u);
      CHECK(std::hypot(u, 31) == Approx(radius(angle)).epsilon(1e-4));
    }
  // the seam of the periodic spline is as smooth as the remaining curve
  const auto curve = ClosedCurve::spline(outline).value();
  const auto start = curve.at(0), end = curve.at(curve.last());
  CHECK((start.position - end.position).norm() < 1e-12);
  CHECK((start.first - end.first).norm() < 1e-12);
}

TEST_CASE("closed curves: lengths, nearest points, and what is refused") {
  const auto circle = ClosedCurve::ellipse(10, 10).value();
  CHECK(circle.length() == Approx(20 * M_PI).epsilon(1e-14));
  CHECK(circle.at_arc_length(-5 * M_PI) == Approx(1.5 * M_PI).epsilon(1e-14));
  for (const double angle : {0.0, 0.001, 1.0, 3.0, 6.28}) {
    const Eigen::Vector2d on(10 * std::cos(angle), 10 * std::sin(angle));
    CHECK((circle.at(circle.nearest(on)).position - on).norm() < 1e-12);
  }
  CHECK(ClosedCurve::polygon(points({{0, 0}, {3, 0}, {3, 4}})).value().length() == Approx(12));

  CHECK_THAT(refusal(ClosedCurve::polygon(points({{0, 0}, {10, 10}, {10, 0}, {0, 8}}))),
             Catch::StartsWith("the closed curve crosses itself near ("));
  CHECK(refusal(ClosedCurve::polygon(points({{0, 0}, {1, 1}}))) ==
        "a closed curve: got 2 points, expected at least 3");
  CHECK(refusal(ClosedCurve::spline(points({{0, 0}, {1, 1}, {1, 1}, {0, 3}}))) ==
        "points 2 and 3 of the closed curve are the same");
  CHECK(refusal(ClosedCurve::polygon(points({{0, 0}, {1, NAN}, {1, 2}}))) ==
        "point 2 of the closed curve is not finite");
  CHECK(refusal(ClosedCurve::ellipse(0, 1)) == "half axes: got 0 and 1 mm, expected above 0");
  CHECK_FALSE(ClosedCurve::superellipse(1, 1, 0.5));
}

TEST_CASE("boundary maps: by arc length and by angle") {
  const auto ellipse = ClosedCurve::ellipse(100, 60).value();
  const auto circle = ClosedCurve::ellipse(50, 50).value();
  const auto by_angle = BoundaryMap::make(ellipse, circle, Correspondence::angle).value();
  const auto by_length = BoundaryMap::make(ellipse, circle, Correspondence::arc_length).value();
  for (const double t : {0.0, 0.4, 1.9, 3.0, 4.4, 6.0}) {
    const Eigen::Vector2d on = ellipse.at(t).position;
    CHECK((by_angle(on) - 50 * on.normalized()).norm() < 1e-12);
    const double angle = 2 * M_PI * ellipse.arc_length(t) / ellipse.length();
    CHECK((by_length(on) - 50 * Eigen::Vector2d(std::cos(angle), std::sin(angle))).norm() < 1e-10);
  }
  // a circle shrinks evenly in both directions
  const auto large = ClosedCurve::ellipse(126, 126).value();
  for (const auto how : {Correspondence::angle, Correspondence::arc_length}) {
    const auto shrink = BoundaryMap::make(large, circle, how).value();
    const Eigen::Vector2d on(126 * std::cos(2.0), 126 * std::sin(2.0));
    CHECK((shrink(on) - on * 50 / 126).norm() < 1e-11);
  }
  // polygons start anywhere, also in the middle of an edge
  const auto square =
      ClosedCurve::polygon(points({{-10, -10}, {10, -10}, {10, 10}, {-10, 10}})).value();
  const auto half = ClosedCurve::polygon(points({{5, 5}, {-5, 5}, {-5, -5}, {5, -5}})).value();
  const auto scale = BoundaryMap::make(square, half, Correspondence::arc_length).value();
  CHECK((scale({10, 3}) - Eigen::Vector2d(5, 1.5)).norm() < 1e-12);
  CHECK((scale({-10, -3}) - Eigen::Vector2d(-5, -1.5)).norm() < 1e-12);

  const auto away = ClosedCurve::polygon(points({{1, 1}, {3, 1}, {2, 3}})).value();
  CHECK(refusal(BoundaryMap::make(circle, away, Correspondence::angle)) ==
        "the origin is not inside the actuated boundary");
  const auto hook =
      ClosedCurve::polygon(points({{-1, -1}, {9, -1}, {9, 9}, {3, 9}, {6, 6}, {6, 2}, {-1, 2}}))
          .value();
  CHECK_THAT(refusal(BoundaryMap::make(hook, circle, Correspondence::angle)),
             Catch::Contains("meets the original boundary more than once: use correspondence "
                             "\"arc_length\""));
  CHECK(BoundaryMap::make(hook, circle, Correspondence::arc_length));
}

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
        "the cap's cut height: got 1 of the radius, expected 0 to below 1");
  CHECK_FALSE(cap_of(net, -0.1));
  CHECK_FALSE(cap_of(net, std::nan("")));
}

TEST_CASE("half of a surface of revolution: long edges in z = 0, rings at the ends") {
  for (const auto& profile : {cylinder_profile(40, 75).value(), spool_profile(100, 0.5).value()}) {
    const RevolutionNet net = right_angled(profile);
    const double length = 150;
    const auto half = half_of(net, length).value();
    // on the base, on a ring, or on both
    const auto at_edge = [&](double u, double v) {
      const Eigen::Vector3d p = net.at(u, v).value().position;
      CHECK(p.z() > -1e-11);
      CHECK(std::abs(p.x()) < length / 2 + 1e-11);
      return int(std::abs(p.z()) < 1e-11) + int(std::abs(std::abs(p.x()) - length / 2) < 1e-11);
    };
    for (const Family family : {Family::u, Family::v}) {
      for (double c = -0.99 * half->reach(); c < half->reach(); c += 7.3) {
        const auto pieces = half->intervals(family, c);
        REQUIRE(pieces.size() == 1);
        for (const double at : {pieces[0].begin, pieces[0].end})
          CHECK((family == Family::u ? at_edge(at, c) : at_edge(c, at)) > 0);
      }
      CHECK(half->intervals(family, 1.001 * half->reach()).empty());
    }
    for (const int points : {4, 5, 6, 7, 100}) {
      const Eigen::Matrix2Xd ring = half->boundary(points);
      REQUIRE(ring.cols() == points);
      int corners = 0;
      for (const auto& uv : ring.colwise()) {
        const int edges = at_edge(uv[0], uv[1]);
        CHECK(edges > 0);
        corners += edges == 2;
      }
      CHECK(corners == 4);
    }
  }
}

TEST_CASE("half of a surface of revolution: too long says where the net ends") {
  const Profile spool = spool_profile(100, 0.5).value();
  const RevolutionNet net = right_angled(spool);
  CHECK_THAT(refusal(half_of(net, 1000)),
             Catch::Contains("folds (shear angle 180 degrees) where u + v = -18") &&
                 Catch::Contains("-500 mm is past its end"));
  CHECK_FALSE(half_of(net, 0));
}
