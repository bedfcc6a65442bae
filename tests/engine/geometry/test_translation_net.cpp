#include <catch2/catch.hpp>
#include <cmath>

#include "engine/geometry/chebyshev_net.h"
#include "tests/engine/geometry/net_checks.h"

using namespace gridshell;

namespace {

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
        "curve_u: a curve needs at least 4 points, not 2");

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
