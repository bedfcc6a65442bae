#include <catch2/catch.hpp>
#include <cmath>

#include "engine/geometry/calculus.h"

using namespace gridshell;

TEST_CASE("antiderivative: known integrals to machine accuracy") {
  const Antiderivative sine([](double t) { return std::cos(t); }, {-3, 1, 20}, 0);
  for (const double t : {-3.0, -1.1, 0.0, 0.4, 1.0, 7.7, 20.0})
    CHECK(std::abs(sine(t) - std::sin(t)) < 1e-14);
  // a kink between the breaks is found by halving
  const Antiderivative kink([](double t) { return std::abs(t - 0.3); }, {0, 1}, 0);
  CHECK(std::abs(kink(1) - (0.045 + 0.245)) < 1e-15);
  // and an integrable singularity at an end
  const Antiderivative root([](double t) { return 1 / std::sqrt(1 - t * t); },
                            {-0.999999, 0.999999}, 0);
  CHECK(std::abs(root(0.999999) - std::asin(0.999999)) < 1e-13);
  CHECK(std::abs(root(-0.999999) + root(0.999999)) < 1e-13);
}

TEST_CASE("antiderivative: the inverse undoes it, ends included") {
  const Antiderivative exponential([](double t) { return std::exp(t); }, {-2, 0, 3}, 0.5);
  for (const double t : {-2.0, -1.99, 0.0, 0.5, 2.0, 3.0})
    CHECK(std::abs(exponential.inverse(exponential(t)) - t) < 2e-15);
}
