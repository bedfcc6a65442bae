// The root of a function of one variable whose slope is known.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace gridshell {

/// Root in [low, high] of a function that is below zero at `low` and not at `high`, by Newton's
/// steps from `start`, halving where one leaves what is left of the interval. `look(t)` is
/// {value, slope}; it ends with a step of `smallest` or less, or after 200.
template <class Look>
double bracketed_root(const Look& look, double low, double high, double start, double smallest) {
  double t = start;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const Eigen::Vector2d here = look(t);
    (here[0] >= 0 ? high : low) = t;
    double next = t - here[0] / here[1];
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    const double step = std::abs(next - t);
    t = next;
    if (step <= smallest || high - low <= smallest) break;
  }
  return t;
}

}  // namespace gridshell
