#include "engine/record/shape_measures.h"

#include <catch2/catch.hpp>

using namespace gridshell;

namespace {

/// A square grid of joints about (3, -2), with a height z(x, y) about the middle.
template <class Height>
void grid(const Height& height, Eigen::Matrix2Xd& flat, Eigen::Matrix3Xd& shape) {
  flat.resize(2, 36);
  shape.resize(3, 36);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double x = i - 2.5, y = j - 2.5;
      flat.col(6 * i + j) << 20 * x + 3, 20 * y - 2;
      shape.col(6 * i + j) << 18 * x + 3, 18 * y - 2, height(x, y);
    }
}

int order_of(double (*height)(double, double)) {
  Eigen::Matrix2Xd flat;
  Eigen::Matrix3Xd shape;
  grid(height, flat, shape);
  return SharedSymmetry(flat, shape, 1e-9).order();
}

}  // namespace

TEST_CASE("symmetries that a shape shares with its footprint") {
  CHECK(order_of([](double x, double y) { return x * x + y * y; }) == 8);
  CHECK(order_of([](double x, double y) { return x * y; }) == 4);
  CHECK(order_of([](double x, double y) { return x * x + 2 * y * y; }) == 4);
  // a rotation alone
  CHECK(order_of([](double x, double y) { return x * y * (x * x - y * y); }) == 4);
  CHECK(order_of([](double x, double) { return x; }) == 2);
  CHECK(order_of([](double x, double y) { return x + 0.3 * y * y * y; }) == 1);
}

TEST_CASE("what breaks a symmetry") {
  Eigen::Matrix2Xd flat;
  Eigen::Matrix3Xd dome, tilted;
  grid([](double x, double y) { return 9 - x * x - y * y; }, flat, dome);
  grid([](double x, double y) { return 9 - x * x - y * y + 0.25 * x; }, flat, tilted);
  const SharedSymmetry symmetry(flat, dome, 1e-9);
  CHECK(root_mean_square(symmetry.broken(dome)) < 1e-12);
  const Eigen::Matrix3Xd broken = symmetry.broken(tilted);
  // the tilt alone is left, whose mean square over the six columns is 0.0625 * 35 / 12
  CHECK(root_mean_square(broken) == Approx(std::sqrt(0.0625 * 35 / 12)));
  // the other side of the same
  grid([](double x, double y) { return 9 - x * x - y * y - 0.25 * x; }, flat, tilted);
  CHECK((symmetry.broken(tilted) + broken).norm() < 1e-9);
}
