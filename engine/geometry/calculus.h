// Functions of one variable: roots by Newton's method, and antiderivatives by quadrature.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <vector>

namespace gridshell {

/// Root in [low, high] of a function that is below zero at `low` and not below zero at `high`.
/// Newton's method from `start`, with a bisection if a step leaves the remaining interval.
/// `look(t)` returns {value, slope}. It ends after a step of at most `smallest`, or after 200
/// steps.
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

/// F(t) = integral of f from an origin to t, and its inverse, to machine accuracy; for arc lengths.
/// Gauss-Legendre quadrature on panels, which are halved until the integral over a panel equals the
/// sum over its halves, also near an integrable singularity at an end.
class Antiderivative {
 public:
  /// `breaks`: the positions where f is not smooth, ascending; the first and last are the ends of
  /// its range. F is zero at `origin`, which is in the range.
  Antiderivative(std::function<double(double)> f, const std::vector<double>& breaks, double origin);

  double begin() const { return ends_.front(); }  ///< start of the range
  double end() const { return ends_.back(); }     ///< end of the range
  double operator()(double t) const;              ///< F(t), t in the range

  /// t with F(t) = value, for f > 0 and value in [F(begin), F(end)]: bracketed Newton iteration.
  double inverse(double value) const;

 private:
  void add_panel(double a, double b, double whole, double small);
  double panel(double a, double b) const;

  std::function<double(double)> f_;
  std::vector<double> ends_, values_;  ///< panel ends, ascending, and F there
};

}  // namespace gridshell
