// Nets on the sphere and of two curves that are moved along one another.
#include <cmath>

#include "engine/geometry/chebyshev_net.h"
#include "tests/engine/geometry/net_checks.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

/// visit(u, v) over the square that contains the hemisphere's footprint, without the folded corners
template <class Visit>
void each_point(double radius, Visit visit) {
  for (double u = -1.5; u <= 1.58; u += 0.0771)
    for (double v = -1.55; v <= 1.58; v += 0.1043)
      if (std::abs(u * v) < 1.8) visit(u * radius, v * radius);
}

/// n + 1 points of a circular arc of angle 2 a in the xz- (axis 0) or yz-plane (axis 1)
Eigen::Matrix3Xd arc(double radius, double a, int n, int axis) {
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, n + 1);
  for (int k = 0; k <= n; ++k) {
    const double angle = a * (2.0 * k / n - 1);
    points(axis, k) = radius * std::sin(angle);
    points(2, k) = radius * std::cos(angle);
  }
  return points;
}

}  // namespace

TEST_CASE("sphere net: shear angle has the known values") {
  CHECK(std::abs(SphereNet::shear(1) - 0.62276356305489) < 5e-15);
  CHECK(SphereNet::shear(0) == M_PI_2);
  // f = pi/2 - z + z^3/18 - ...
  const double z = 1e-3;
  CHECK(std::abs(SphereNet::shear(z) - (M_PI_2 - z + z * z * z / 18)) < 1e-15);
  for (const double at : {0.3, 0.99, 1.5, 1.8})
    CHECK(std::abs(SphereNet::shear(-at) + SphereNet::shear(at) - M_PI) < 1e-15);
  // its first zero
  CHECK(SphereNet::shear(1.86159167725) > 0);
  CHECK(SphereNet::shear(1.86159167735) < 0);
  CHECK(std::abs(SphereNet::shear(SphereNet::fold)) < 1e-10);
}

TEST_CASE("sphere net: on the sphere, at unit speed, at the shear angle, for any radius") {
  for (const double radius : {1.0, 76.394, 1e-3, 2e5}) {
    const SphereNet net(radius);
    double off_sphere = 0, off_unit = 0, off_tangent = 0, off_angle = 0;
    each_point(radius, [&](double u, double v) {
      const NetPoint p = point_of(net, u, v);
      off_sphere = std::max(off_sphere, std::abs(p.position.norm() / radius - 1));
      off_unit = std::max(off_unit, unit_residual(net, u, v));
      off_tangent = std::max({off_tangent, std::abs(p.position.dot(p.tangent_u)) / radius,
                              std::abs(p.position.dot(p.tangent_v)) / radius});
      off_angle =
          std::max(off_angle, std::abs(p.omega - SphereNet::shear(u / radius * (v / radius))));
    });
    CHECK(off_sphere < 1e-12);
    CHECK(off_unit < 1e-12);
    CHECK(off_tangent < 1e-12);
    CHECK(off_angle < 1e-12);
  }
}

TEST_CASE("sphere net: axes are great circles through the pole, and the frame is as named") {
  const SphereNet net(10);
  for (const double s : {-12.0, 0.0, 3.0, 15.0, 29.0}) {
    const double a = s / 10;
    const Eigen::Vector3d on_u(10 * std::sin(a), 0, 10 * std::cos(a));
    const Eigen::Vector3d on_v(0, 10 * std::sin(a), 10 * std::cos(a));
    CHECK((point_of(net, s, 0).position - on_u).norm() < 1e-13);
    CHECK((point_of(net, 0, s).position - on_v).norm() < 1e-13);
  }
  CHECK((point_of(net, 2, 3).normal() - point_of(net, 2, 3).position / 10).norm() < 1e-14);
  CHECK(point_of(net, 2, 3).K == Approx(0.01));
}

TEST_CASE("sphere net: C_u and C_v integrate to C, Gauss and Hazzidakis") {
  const SphereNet net(50);
  CHECK(tangent_residual(net, -20, 75, 45, 75) < 50e-12);
  CHECK(tangent_residual(net, 10, 50, -40, 35) < 50e-12);
  for (const double u : {-30.0, 10.0, 45.0})
    for (const double v : {-20.0, 5.0, 40.0}) {
      CHECK(mixed_residual(net, u, v, 10) < 1e-10);
      CHECK(gauss_residual(net, u, v, 50) < 1e-9);
    }
  CHECK(hazzidakis_residual(net, -20, 49, 3, 49) < 1e-12);
  CHECK(hazzidakis_residual(net, -60, 10, -15, 50) < 1e-12);
}

TEST_CASE("sphere net: a fold is named with its position") {
  const SphereNet net(10);
  CHECK(net.at(13.6, 13.6));
  CHECK(refusal(net.at(13.7, 13.7)) ==
        "the net on the sphere of radius 10 mm folds (shear angle 0) where u v = 186.1592 mm^2; "
        "(u, v) = (13.7, 13.7) mm is past its end");
  CHECK(refusal(net.at(13.7, -13.7)) ==
        "the net on the sphere of radius 10 mm folds (shear angle 180 degrees) where u v = "
        "-186.1592 mm^2; (u, v) = (13.7, -13.7) mm is past its end");
  CHECK_FALSE(net.at(std::nan(""), 1));
}

TEST_CASE("translation net: the sum of two arcs") {
  std::vector<double> errors;
  for (const int n : {20, 40, 80}) {
    const TranslationNet net = TranslationNet::make(arc(50, 1, n, 0), arc(30, 0.7, n, 1)).value();
    CHECK(net.half_u() == Approx(50).epsilon(1e-5));
    CHECK(net.half_v() == Approx(21).epsilon(1e-5));
    double error = 0;
    for (double u = -45; u < 45; u += 0.9) {
      for (double v = -17; v < 17; v += 1.7) {
        const NetPoint p = point_of(net, u, v);
        const double a = u / 50, b = v / 30;
        const Eigen::Vector3d exact(50 * std::sin(a), 30 * std::sin(b),
                                    50 * std::cos(a) + 30 * std::cos(b));
        error = std::max(error, (p.position - exact).norm());
        CHECK(unit_residual(net, u, v) < 1e-14);
        // C_uv = 0: each tangent depends on its own parameter alone
        CHECK((point_of(net, u, v + 3).tangent_u - p.tangent_u).norm() == 0);
        CHECK((point_of(net, u + 3, v).tangent_v - p.tangent_v).norm() == 0);
        // cos omega = sin a sin b
        CHECK(std::cos(p.omega) == Approx(std::sin(a) * std::sin(b)).margin(1e-4));
      }
    }
    errors.push_back(error);
    CHECK(tangent_residual(net, -10, 7, -5, 6) < 1e-11);
    // a patch without a knot inside, where K of the splines is smooth
    const double knot_u = 100.0 / n, knot_v = 42.0 / n;
    CHECK(hazzidakis_residual(net, 0.1 * knot_u, 0.9 * knot_u, 0.1 * knot_v, 0.9 * knot_v) < 1e-12);
  }
  CHECK(errors[2] < 1e-5);
  CHECK(errors[0] / errors[1] > 12);
  CHECK(errors[1] / errors[2] > 12);
}

TEST_CASE("translation net: bad curves, ends and folds are named") {
  const Eigen::Matrix3Xd x = arc(50, 1, 20, 0), y = arc(30, 0.7, 20, 1);
  Eigen::Matrix3Xd twice = y;
  twice.col(4) = twice.col(3);
  CHECK(TranslationNet::make(x, twice).error().message ==
        "curve_v: points 4 and 5 of the curve are the same");
  CHECK(TranslationNet::make(x.leftCols(2), y).error().message ==
        "curve_u: a curve: got 2 points, expected at least 4");

  const TranslationNet net = TranslationNet::make(x, y).value();
  CHECK(net.at(0, 30).error().message.find("curve_v of the translation net ends at v = 2") == 0);
  CHECK_FALSE(net.at(std::nan(""), 0));

  // two curves of one plane: parallel in their middles; turned by 0.5: parallel further out
  const auto parallel = TranslationNet::make(x, x);
  REQUIRE_FALSE(parallel);
  CHECK(parallel.error().message.find("the translation net folds (shear angle 0) near (u, v) = ") ==
        0);
  Eigen::Matrix3Xd turned = x;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()).toRotationMatrix();
  turned = turn * turned;
  CHECK_FALSE(TranslationNet::make(x, turned));
}
