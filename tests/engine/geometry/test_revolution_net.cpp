#include <cmath>

#include "engine/geometry/revolution_net.h"
#include "tests/engine/geometry/net_checks.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

/// all residuals at points (u, v) with |u + v| below `reach`, lengths over `scale`
void check_smooth_net(const RevolutionNet& net, double reach, double scale) {
  for (const double x : {-0.95, -0.4, 0.0, 0.3, 0.9}) {
    for (const double y : {-1.3, 0.0, 0.8}) {
      const double u = (x * reach + y * scale) / 2, v = (x * reach - y * scale) / 2;
      CHECK(unit_residual(net, u, v) < 1e-13);
      CHECK(mixed_residual(net, u, v, 0.2 * scale) < 1e-10);
      CHECK(gauss_residual(net, u, v, 0.2 * scale) < 1e-9);
      const NetPoint p = point_of(net, u, v);
      const double r = std::hypot(p.position.y(), p.position.z());
      CHECK(std::abs(std::sin(p.omega / 2) - net.c() * r) < 1e-13);
    }
  }
  CHECK(tangent_residual(net, -0.4 * reach, 0.5 * reach, -0.3 * reach, 0.4 * reach) <
        1e-11 * scale);
  CHECK(hazzidakis_residual(net, -0.4 * reach, 0.5 * reach, -0.3 * reach, 0.4 * reach) < 1e-11);
}

}  // namespace

TEST_CASE("cylinder net: helices, at right angles everywhere") {
  const double R = 40;
  const RevolutionNet net = right_angled(cylinder_profile(R, 200).value());
  CHECK(net.c() == Approx(1 / (std::sqrt(2) * R)).epsilon(1e-15));
  check_smooth_net(net, 250, R);
  for (const double u : {-70.0, 0.0, 33.0}) {
    for (const double v : {-50.0, 0.0, 61.0}) {
      const double phi = (u - v) / (std::sqrt(2) * R);
      const Eigen::Vector3d helix((u + v) / std::sqrt(2), -R * std::sin(phi), R * std::cos(phi));
      const NetPoint p = point_of(net, u, v);
      CHECK((p.position - helix).norm() < 1e-12);
      CHECK(std::abs(p.omega - M_PI_2) < 1e-14);
      CHECK(std::abs(p.K) < 1e-18);
    }
  }
  // outwards is up on top
  CHECK(point_of(net, 3, 3).normal().z() == Approx(1));
}

TEST_CASE("spool net: K = -1/rho^2 and unit speed for any waist and c") {
  const double rho = 60;
  for (const double waist : {0.3, 1.0, 1.7}) {
    const Profile profile = spool_profile(rho, waist).value();
    // right angles in the middle, and the net of the asymptotic lines
    for (const double c : {right_angled(profile).c(), 1 / (rho * std::sqrt(1 + waist * waist))}) {
      const RevolutionNet net = RevolutionNet::make(profile, c).value();
      const double reach = 0.9 * net.last_x();
      check_smooth_net(net, reach, 0.4 * reach);
      CHECK(point_of(net, 0.1 * reach, 0.5 * reach).K * rho * rho == Approx(-1).epsilon(1e-12));
      CHECK(net.first_x() == Approx(-net.last_x()).epsilon(1e-9));
    }
  }
}

TEST_CASE("spool net: radius and height follow r = rho a cosh(s/rho)") {
  const double rho = 60, a = 0.8;
  const RevolutionNet net = right_angled(spool_profile(rho, a).value());
  // s from r, and the height by quadrature over s
  for (const double x : {-40.0, -3.0, 20.0, 50.0}) {
    const NetPoint p = point_of(net, x / 2, x / 2);
    const double s = std::acosh(p.position.z() / (rho * a));
    const double height = integral(
        [&](double t) { return rho * std::sqrt(1 - a * a * std::sinh(t) * std::sinh(t)); }, 0, s);
    CHECK(std::abs(p.position.x()) == Approx(height).epsilon(1e-10));
    const double length = integral(
        [&](double t) { return rho / std::sqrt(1 - std::cosh(t) * std::cosh(t) / 2); }, 0, s);
    CHECK(std::abs(x) == Approx(length).epsilon(1e-10));
  }
}

TEST_CASE("pseudosphere net: K = -1/rho^2, r falls off as exp(-s/rho)") {
  const double rho = 60;
  const RevolutionNet net = right_angled(beltrami_profile(rho, 0.5).value());
  check_smooth_net(net, 45, 20);
  for (const double x : {-30.0, 10.0, 200.0}) {
    const NetPoint p = point_of(net, x / 2, x / 2);
    CHECK(p.K * rho * rho == Approx(-1).epsilon(1e-11));
    // s = -rho ln(r / r_middle); ds/dx = sqrt(1 - c^2 r^2)
    const double s = -rho * std::log(p.position.z() / 30);
    const double length =
        integral([&](double t) { return 1 / std::sqrt(1 - std::exp(-2 * t / rho) / 2); },
                 std::min(0., s), std::max(0., s));
    CHECK(std::abs(x) == Approx(length).epsilon(1e-10));
  }
}

TEST_CASE("tabulated profile: residuals as for the others, fourth order in the points' distance") {
  // a bulging profile, compared with itself on many more points
  const auto table = [](int n) {
    Eigen::Matrix2Xd r_z(2, n + 1);
    for (int k = 0; k <= n; ++k) {
      const double z = -50 + 100.0 * k / n;
      r_z.col(k) << 30 + 8 * std::cos(z / 20), z;
    }
    return r_z;
  };
  const double c = 0.6 / 38;
  const RevolutionNet exact =
      RevolutionNet::make(tabulated_profile(table(3200)).value(), c).value();
  std::vector<double> errors;
  for (const int n : {50, 100, 200}) {
    const RevolutionNet net = RevolutionNet::make(tabulated_profile(table(n)).value(), c).value();
    for (const double x : {-50.0, 0.0, 31.0}) CHECK(unit_residual(net, x, 7 - x) < 1e-13);
    CHECK(tangent_residual(net, -3, 2, -1, 4) < 1e-10);
    // a patch without a knot inside, where K of the spline is smooth
    const double knot = 50.0 / n;
    CHECK(hazzidakis_residual(net, 0.1 * knot, knot, 0.1 * knot, knot) < 1e-12);
    CHECK(mixed_residual(net, 0.6 * knot, 0.6 * knot, 5 * knot) < 1e-10);
    double error = 0;
    for (double u = -23; u < 23; u += 0.37)
      error =
          std::max(error, (point_of(net, u, 5).position - point_of(exact, u, 5).position).norm());
    errors.push_back(error);
  }
  CHECK(errors[0] < 1e-4);
  CHECK(errors[0] / errors[1] > 12);
  CHECK(errors[1] / errors[2] > 12);
}

TEST_CASE("surfaces of revolution: folds and ends are named with their position") {
  const Profile spool = spool_profile(100, 0.5).value();
  const RevolutionNet net = right_angled(spool);
  // r = sqrt(2) r_waist where the rods turn around the axis
  const NetPoint edge = point_of(net, net.last_x() / 2, net.last_x() / 2);
  CHECK(std::hypot(edge.position.y(), edge.position.z()) ==
        Approx(50 * std::sqrt(2)).epsilon(1e-5));
  CHECK_THAT(refusal(net.at(100, 100)),
             Catch::StartsWith("the net on the spool of radius 100 mm and waist 0.5 folds "
                               "(shear angle 180 degrees) where u + v = 18") &&
                 Catch::Contains("mm along the axis; (u, v) = (100, 100) mm is past its end"));
  CHECK_THAT(refusal(net.at(-100, -100)), Catch::Contains("where u + v = -18"));

  CHECK(refusal(RevolutionNet::make(spool, 0.03)) ==
        "no net exists on the spool of radius 100 mm and waist 0.5 with c = 0.03 / mm: in its "
        "middle sin(omega/2) = c r is 1.5, expected between 0 and 1");
  CHECK_FALSE(RevolutionNet::make(spool, -1));

  const RevolutionNet cylinder = right_angled(cylinder_profile(40, 100).value());
  CHECK(refusal(cylinder.at(80, 80)) ==
        "the cylinder of radius 40 mm ends where u + v = 141.4214 mm, 100 mm along the axis; (u, "
        "v) = "
        "(80, 80) mm is past its end");
  CHECK(cylinder.x_at_axial(100));
  CHECK_FALSE(cylinder.x_at_axial(100.1));
}

TEST_CASE("a profile may be listed upwards or downwards") {
  Eigen::Matrix2Xd r_z(2, 9);
  for (int k = 0; k < 9; ++k) r_z.col(k) << 50 + 0.1 * k * k, 10.0 * k;
  const auto net = [](const Eigen::Matrix2Xd& points) {
    return value_of(RevolutionNet::make(value_of(tabulated_profile(points)), 0.01));
  };
  const RevolutionNet up = net(r_z), down = net(r_z.rowwise().reverse());
  CHECK(value_of(up.x_at_axial(20)) > 0);
  CHECK(value_of(down.x_at_axial(20)) == Approx(value_of(up.x_at_axial(20))));
}

TEST_CASE("profiles: what is no surface is refused") {
  CHECK(refusal(cylinder_profile(0, 1)) == "the cylinder's radius: got 0, expected above 0");
  CHECK(refusal(cylinder_profile(1, -2)) == "the cylinder's length: got -4, expected above 0");
  CHECK_FALSE(spool_profile(1, 0));
  CHECK_FALSE(spool_profile(std::nan(""), 1));
  CHECK_FALSE(beltrami_profile(1, 1));
  Eigen::Matrix2Xd r_z(2, 4);
  r_z << 1, 2, 3, 4, 0, 1, 2, 3;
  CHECK(tabulated_profile(r_z));
  r_z(0, 2) = -3;
  CHECK(refusal(tabulated_profile(r_z)) ==
        "radius of point 3 of the profile: got -3 mm, expected above 0");
  r_z(0, 2) = std::nan("");
  CHECK(refusal(tabulated_profile(r_z)) == "point 3 of the curve is not finite");
  CHECK(refusal(tabulated_profile(r_z.leftCols(3))) ==
        "a curve: got 3 points, expected at least 4");
}
