// Translation nets C(u, v) = X(u) + Y(v).
#pragma once

#include "engine/geometry/chebyshev_net.h"
#include "engine/geometry/spline_curve.h"

namespace gridshell {

/// The sum of two unit-speed curves is a Chebyshev net with C_uv = 0; u = v = 0 at their middles,
/// whose sum lies where the curves put it.
class TranslationNet final : public ChebyshevNet {
 public:
  /// `x` and `y`: points of the two curves, 3 x n, mm. Errors (bad_input): those of
  /// SplineCurve::through with the curve's name; a fold anywhere on the net, where the curves
  /// become parallel.
  static Result<TranslationNet> make(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& y);

  double half_u() const { return x_.half_length(); }  ///< the net exists for |u| <= half_u
  double half_v() const { return y_.half_length(); }  ///< and |v| <= half_v
  Result<NetPoint> at(double u, double v) const override;

 private:
  TranslationNet(UnitSpeedCurve x, UnitSpeedCurve y) : x_(std::move(x)), y_(std::move(y)) {}
  Result<void> check_open() const;
  UnitSpeedCurve x_, y_;
};

}  // namespace gridshell
