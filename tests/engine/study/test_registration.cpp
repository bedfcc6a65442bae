// Points laid on places.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <random>

#include "engine/study/scan.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::study;

namespace {

/// a bump without symmetry
Eigen::Matrix3Xd bump() {
  Eigen::Matrix3Xd places(3, 49);
  for (int k = 0; k < 49; ++k) {
    const int column = k % 7 - 3, row = k / 7 - 3;
    const double x = 20 * column, y = 20 * row;
    places.col(k) << x, y, 40 * std::exp(-(x * x + 2 * y * y + x * y) / 3000) + 0.1 * x;
  }
  return places;
}

const Pose tilted{Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 2, -2) / 3).toRotationMatrix(),
                  {500, -20, 7}};

}  // namespace

TEST_CASE("places find their points again in any pose, exactly") {
  const Eigen::Matrix3Xd places = bump(), points = tilted.of(places);
  const auto found = value_of(register_points(points, places, {}));
  CHECK(found.found == 49);
  for (int k = 0; k < 49; ++k) CHECK(found.point_of[std::size_t(k)] == k);
  CHECK(found.distance.maxCoeff() < 1e-9);
  CHECK((found.pose.of(points) - places).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(found.cost < 1e-15);
}

TEST_CASE("a third missing and as many that belong nowhere mislead nobody") {
  const Eigen::Matrix3Xd places = bump();
  Eigen::Matrix3Xd points(3, 49);
  std::mt19937_64 draw(3);
  std::uniform_real_distribution<double> share(-1, 1);
  for (int k = 0; k < 49; ++k)
    points.col(k) = k % 3 == 0
                        ? Eigen::Vector3d(90 * share(draw), 90 * share(draw), 60 + 40 * share(draw))
                        : Eigen::Vector3d(places.col(k));
  const auto found = value_of(register_points(tilted.of(points), places, {}));
  CHECK(found.found == 32);
  for (int k = 0; k < 49; ++k) CHECK(found.point_of[std::size_t(k)] == (k % 3 == 0 ? -1 : k));
  CHECK(found.cost == Approx(17 * 9));
}

TEST_CASE("a mirror image is another shape, and too few points tell no pose") {
  const Eigen::Matrix3Xd places = bump();
  const Eigen::Matrix3Xd mirrored = Eigen::Vector3d(-1, 1, 1).asDiagonal() * places;
  const auto found = value_of(register_points(tilted.of(mirrored), places, {}));
  CHECK(found.cost > 49);
  CHECK(found.pose.turn.determinant() == Approx(1));
  CHECK_FALSE(register_points(places.leftCols(3), places, {}));
  CHECK_FALSE(register_points(Eigen::Matrix3Xd::Zero(3, 10), places, {}));
}
