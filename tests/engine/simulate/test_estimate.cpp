#include <catch2/catch.hpp>

#include "tests/engine/simulate/random_scenes.h"

using namespace gridshell;

// six of the scenes that bench_engine_estimate goes through
TEST_CASE("random circles: the error estimate is honest and useful, the tolerance is met",
          "[full]") {
  std::mt19937 random(2018);
  int judged = 0;
  for (int k = 0; k < 4; ++k) {
    const EstimateTrial t = try_estimate(random_scene(random));
    INFO(t.scene << " " << t.refused << " error " << t.truth << " estimate " << t.estimate);
    if (!t.refused.empty()) continue;
    ++judged;
    CHECK(t.truth < 2 * t.estimate);
    CHECK(t.estimate <= 5 * t.truth);
    CHECK(t.truth <= t.tolerance);
  }
  CHECK(judged >= 3);
}
