// F(t) = integral of f from an origin to t, and its inverse, to machine accuracy: arc length and
// the like.
#pragma once

#include <functional>
#include <vector>

namespace gridshell {

/// Gauss-Legendre quadrature on panels that are halved until they agree with their halves (also
/// beside an integrable singularity at an end).
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
