// The study of error estimates: random scenes (100, or as many as the argument says), each with its
// estimate beside its true error, and how often the promises hold.
#include <cstdio>
#include <cstdlib>

#include "tests/engine/simulate/random_scenes.h"

using namespace gridshell;

int main(int argc, char** argv) {
  const int scenes = argc > 1 ? std::atoi(argv[1]) : 100;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  std::mt19937 random(2018);
  int judged = 0, within_2 = 0, within_10 = 0, useful = 0, met = 0, refused = 0;
  for (int k = 0; k < scenes; ++k) {
    const EstimateTrial t = try_estimate(random_scene(random));
    if (!t.refused.empty()) {
      ++refused;
      fmt::print("{:3} {}  no state: {}\n", k, t.scene, t.refused);
      continue;
    }
    ++judged;
    within_2 += t.truth < 2 * t.estimate;
    within_10 += t.truth < 10 * t.estimate;
    useful += t.estimate <= 5 * t.truth;
    met += t.truth <= t.tolerance;
    fmt::print("{:3} {}  error {:.2e} estimate {:.2e}{}{}\n", k, t.scene, t.truth, t.estimate,
               t.truth < 2 * t.estimate ? "" : "  ABOVE TWICE THE ESTIMATE",
               t.truth <= t.tolerance ? "" : "  TOLERANCE NOT MET");
  }
  fmt::print(
      "of {} judged ({} ended with a reason): error below 2 estimates in {}, below 10 in {}, "
      "estimate at most 5 errors in {}, tolerance met in {}\n",
      judged, refused, within_2, within_10, useful, met);
}
