#include "engine/core/algorithms.h"

#include <catch2/catch.hpp>

using namespace gridshell;

TEST_CASE("an error of second order vanishes from the extrapolated value") {
  const auto on = [](double edge) { return 3 + 0.7 * edge * edge; };
  CHECK(richardson(on(0.5), on(1)) == Approx(3).epsilon(1e-14));
  const Eigen::Vector2d fine(on(0.5), 2), coarse(on(1), 2);
  CHECK((richardson(fine, coarse) - Eigen::Vector2d(3, 2)).norm() < 1e-14);
}
