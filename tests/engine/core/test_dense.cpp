// Weights of polynomials through known values and slopes.
#include "engine/core/dense.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace gridshell;

namespace {

const std::vector<double> known{0.1, 0.35, 0.2, 0.6};

double cubed(double t) { return t * t * t - 2 * t + 0.3; }
double seventh(double t) { return std::pow(t, 7) - 3 * std::pow(t, 4) + t; }
double slope_of_seventh(double t) { return 7 * std::pow(t, 6) - 12 * std::pow(t, 3) + 1; }

}  // namespace

TEST_CASE(
    "a polynomial through four values is exact to the third degree, with slopes to the seventh") {
  for (const double t : {0.0, 0.15, 0.35, 0.5}) {
    INFO("t = " << t);
    const Eigen::VectorXd of_values = polynomial_weights(known, t);
    const Eigen::MatrixX2d with_slopes = slope_weights(known, t);
    double third = 0, all = 0;
    for (std::size_t k = 0; k < known.size(); ++k) {
      const auto row = Eigen::Index(k);
      third += of_values[row] * cubed(known[k]);
      all += with_slopes(row, 0) * seventh(known[k]) +
             with_slopes(row, 1) * slope_of_seventh(known[k]);
    }
    CHECK(third == Approx(cubed(t)).epsilon(1e-12));
    CHECK(all == Approx(seventh(t)).margin(1e-12));
    CHECK(polynomial_weights(known, t, 2)[2] == 0);
  }
}

TEST_CASE("a tridiagonal system is solved as the dense one is") {
  const Eigen::Index n = 5;
  Eigen::VectorXd lower(n), diagonal(n), upper(n);
  lower << 99, 1, -0.5, 0.25, 2;
  diagonal << 4, 3, 5, -4, 6;
  upper << 1.5, -1, 2, 0.5, 99;
  Eigen::MatrixXd A = diagonal.asDiagonal();
  A.diagonal(-1) = lower.tail(n - 1);
  A.diagonal(1) = upper.head(n - 1);
  Eigen::MatrixXd x(2, n);
  x << 1, -2, 0.5, 3, 4, 0, 7, -1, 2, 2.5;
  Eigen::MatrixXd b = x * A.transpose();
  solve_tridiagonal(lower, diagonal, upper, b);
  CHECK((b - x).cwiseAbs().maxCoeff() < 1e-14);
}
