#include <catch2/catch.hpp>
#include <cmath>

#include "app/cli/delivery.h"

using namespace gridshell::app;

TEST_CASE("the bar counts evenly over phases by their expected time") {
  const std::vector<Phase> phases{{"simulating", 10}, {"drawing", 90}};
  CHECK(standing(phases, 0, 0.0, 0).fraction == 0.0);
  CHECK(standing(phases, 0, 0.5, 5).fraction == Approx(0.05));
  CHECK(standing(phases, 1, 0.0, 0).fraction == Approx(0.10));
  CHECK(standing(phases, 1, 0.5, 45).fraction == Approx(0.55));
  CHECK(standing(phases, 1, 1.0, 90).fraction == Approx(1.0));
}

TEST_CASE("the time left follows how fast the work turns out") {
  const std::vector<Phase> phases{{"simulating", 10}, {"drawing", 90}};
  // as expected: 5 s of this phase and 90 s of the next
  CHECK(standing(phases, 0, 0.5, 5).seconds_left == Approx(95));
  // twice as slow
  CHECK(standing(phases, 0, 0.5, 10).seconds_left == Approx(190));
  CHECK(standing(phases, 1, 0.25, 20).seconds_left == Approx(60));
  // too early to tell
  CHECK(std::isnan(standing(phases, 1, 0.01, 1).seconds_left));
  CHECK(std::isnan(standing(phases, 1, 0.5, 0.1).seconds_left));
}

TEST_CASE("the bar shows share, work and time left") {
  CHECK(bar_text({0.5, 125}, "drawing", 10) == "[=====>    ]  50 %  drawing, 2:05 left");
  CHECK(bar_text({0, NAN}, "simulating", 4) == "[>   ]   0 %  simulating");
  CHECK(bar_text({1, 0}, "drawing", 4) == "[====] 100 %  drawing");
  CHECK(bar_text({0.25, 4000}, "drawing", 4) == "[=>  ]  25 %  drawing, 1:06:40 left");
}
