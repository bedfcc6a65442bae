// Nets on surfaces that are given by an expression, compared with known nets.
#include <cmath>

#include "engine/geometry/chebyshev_net.h"
#include "engine/geometry/surface.h"
#include "engine/geometry/surface_net.h"
#include "tests/engine/geometry/net_checks.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

constexpr double rho = 120, d = 20;

Surface surface_of(const std::string& text) {
  const Expression F = Expression::parse(text).value();
  return {[F](const Eigen::Vector3d& p) { return F.at(p); }, d};
}

NetPose on_top(const Eigen::Vector3d& apex, double cut_mm, double turned = 0) {
  return {apex, Eigen::Vector3d(std::cos(turned), std::sin(turned), 0), Eigen::Vector3d::UnitZ(),
          [cut_mm](const Eigen::Vector3d& p) { return cut_mm - p.z(); }};
}

const char* const sphere = "x^2 + y^2 + z^2 - 120^2";

/// largest distance of a net from the sphere's, above the plane z = cut, mm
double off_sphere(const ChebyshevNet& net, double cut_mm, double turned = 0) {
  const SphereNet exact(rho);
  const Eigen::AngleAxisd turn(turned, Eigen::Vector3d::UnitZ());
  double largest = 0;
  int compared = 0;
  for (double u = -186; u <= 186; u += 7.3)
    for (double v = -186; v <= 186; v += 7.3) {
      const auto there = exact.at(u, v);
      if (!there || there->position.z() < cut_mm) continue;
      ++compared;
      const auto here = value_of(net.at(u, v));
      largest = std::max(largest, (here.position - turn * there->position).norm());
    }
  CHECK(compared > 100);
  return largest;
}

/// distance of the nodes of a grid of equal chords from the sphere
double grid_off_sphere(double chord) {
  const SphereNet exact(rho);
  const auto grid =
      value_of(ChordGrid::make(surface_of(sphere), on_top({0, 0, rho}, 0), chord, 2, 2000));
  double largest = 0;
  for (int j = grid.first_v(); j <= grid.last_v(); ++j)
    for (int i = grid.first_u(); i <= grid.last_u(); ++i)
      if (grid.inside(i, j))
        largest =
            std::max(largest, (grid.at(i, j) - exact.at(i * chord, j * chord)->position).norm());
  return largest;
}

std::string refused(const std::string& text, const NetPose& pose) {
  return refusal(SurfaceNet::make(surface_of(text), pose, d / 8));
}

}  // namespace

TEST_CASE("expressions have values, and what is none says where") {
  CHECK(Expression::parse("x^2 + 2*y - sin(z)")->at({3, 4, 0}) == 17);
  CHECK(Expression::parse("x < 2 ? 1 : 5")->at({3, 4, 0}) == 5);
  CHECK_FALSE(std::isfinite(Expression::parse("1/(x - 3)")->at({3, 4, 0})));
  for (const auto& [text, reason] : {std::pair("x^2 + ", "at character"),
                                     {"x^2 + w", "\"w\""},
                                     {"", "at character"},
                                     {"x, y", "2 values"},
                                     {"x^2 = 3", "an equation"}})
    CHECK_THAT(refusal(Expression::parse(text)), Catch::Contains(reason));
}

TEST_CASE("a surface's curvatures are those of the sphere, the saddle and the cylinder") {
  const auto ball = surface_of(sphere).curvature({0, 0, rho});
  CHECK(ball.umbilic);
  CHECK(ball.first == Approx(-1 / rho).epsilon(1e-5));
  const auto saddle = surface_of("z - (x^2 - y^2)/200").curvature({0, 0, 0});
  CHECK_FALSE(saddle.umbilic);
  CHECK(saddle.first == Approx(0.01).epsilon(1e-5));
  CHECK(saddle.second == Approx(-0.01).epsilon(1e-5));
  CHECK(std::abs(saddle.axes(0, 0)) == Approx(1).epsilon(1e-6));
  const auto pipe = surface_of("y^2 + z^2 - 50^2").curvature({0, 0, 50});
  CHECK(pipe.first == Approx(-0.02).epsilon(1e-5));
  CHECK(std::abs(pipe.second) < 1e-7);
  CHECK(std::abs(pipe.axes(1, 0)) == Approx(1).epsilon(1e-6));
}

TEST_CASE(
    "a grid of equal chords converges to the sphere's net with second order, 0.5 um at d/64") {
  const double at_8 = grid_off_sphere(d / 8), at_16 = grid_off_sphere(d / 16);
  CHECK(at_8 / at_16 == Approx(4).epsilon(0.05));
  CHECK(at_16 / 16 <= 5e-4);  // d/64 takes seconds
}

TEST_CASE("the net of the sphere by expression is the sphere's own, however it is turned") {
  for (const double turned : {0.0, 0.4}) {
    const auto net =
        value_of(SurfaceNet::make(surface_of(sphere), on_top({0, 0, rho}, 0, turned), d / 8));
    CHECK(off_sphere(net, 0, turned) <= 5e-4);
    const NetPoint here = point_of(net, 60, -47), there = point_of(SphereNet(rho), 60, -47);
    CHECK(here.omega == Approx(there.omega).epsilon(1e-6));
    CHECK(here.K == Approx(there.K).epsilon(1e-4));
  }
}

TEST_CASE("a net on a surface has rods of unit speed, and obeys Gauss' equation") {
  const auto net = value_of(SurfaceNet::make(surface_of("(x/140)^2 + (y/110)^2 + (z/90)^2 - 1"),
                                             on_top({0, 0, 90}, 0), d / 8));
  CHECK(unit_residual(net, 37, -51) < 1e-9);
  CHECK(mixed_residual(net, 33, -28, 90) < 1e-4);
  CHECK(gauss_residual(net, 33, -28, 90) < 1e-3);
}

TEST_CASE("where a net folds, or its surface or boundary does not serve, it is refused") {
  // most of a sphere: past the equator the net folds
  CHECK_THAT(refused(sphere, on_top({0, 0, rho}, -100)), Catch::Contains("the net folds"));
  // a boundary that no axis reaches
  CHECK_THAT(refused("z - 10", on_top({0, 0, 10}, 0)), Catch::Contains("does not cross"));
  // a surface that ends before its boundary
  CHECK_THAT(refused("z - sqrt(120^2 - x^2 - y^2)", on_top({0, 0, rho}, -10)),
             Catch::Contains("surface ends"));
}
