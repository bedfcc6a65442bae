// The root of a function of one variable whose slope is known.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <vector>

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

// F(t) = integral of f from an origin to t, and its inverse, to machine accuracy: arc length and
// the like.

/// Gauss-Legendre quadrature on panels that are halved until they agree with their halves (also
/// near an integrable singularity at an end).
class Antiderivative {
 public:
  /// `breaks`: where f is not smooth, ascending, with the ends of its range first and last.
  /// F is zero at `origin`, which lies in the range.
  Antiderivative(std::function<double(double)> f, const std::vector<double>& breaks, double origin);

  double begin() const { return ends_.front(); }  ///< of the range
  double end() const { return ends_.back(); }
  double operator()(double t) const;  ///< t in the range

  /// t with F(t) = value, for f > 0 and value in [F(begin), F(end)]: bracketed Newton iteration.
  double inverse(double value) const;

 private:
  void add_panel(double a, double b, double whole, double small);
  double panel(double a, double b) const;

  std::function<double(double)> f_;
  std::vector<double> ends_, values_;  ///< panel ends, ascending, and F there
};

}  // namespace gridshell
