// Chebyshev nets: surfaces C(u, v) whose parameter lines are both parametrised by arc length,
// |C_u| = |C_v| = 1, so that a square grid of inextensible rods lies on them [Baek 2018, eq. 1-2].
#pragma once

#include <Eigen/Core>

#include "engine/core/result.h"
#include "engine/geometry/spline.h"

namespace gridshell {

/// A net at one (u, v).
struct NetPoint {
  Eigen::Vector3d position;   ///< C, mm
  Eigen::Vector3d tangent_u;  ///< C_u, unit
  Eigen::Vector3d tangent_v;  ///< C_v, unit
  double omega = 0;           ///< shear angle between C_u and C_v, rad, in (0, pi)
  double K = 0;               ///< Gauss curvature, mm^-2; Gauss' equation: omega_uv = -K sin omega

  /// Unit normal C_u x C_v / sin omega.
  Eigen::Vector3d normal() const;
};

/// A smooth Chebyshev net in a frame of its own, z up; u, v and positions in mm.
class ChebyshevNet {
 public:
  virtual ~ChebyshevNet() = default;

  /// The net at (u, v). Errors (bad_input): the net folds (omega reaches 0 or pi) or its surface
  /// ends before (u, v), with the position where it does.
  virtual Result<NetPoint> at(double u, double v) const = 0;
};

/// Positions C at every column of `uv`, 3 x n, mm. Errors (bad_input): those of the net.
Result<Eigen::Matrix3Xd> points_on(const ChebyshevNet& net, const Eigen::Matrix2Xd& uv);

/// Chebyshev's net on the sphere, whose axes are two orthogonal great circles through the pole. The
/// centre is the origin, the pole (u = v = 0) is at +z, the u-axis in the xz-plane; radius rho.
///
/// The shear angle is omega = f(uv/rho^2), f' + z f'' = -sin f, f(0) = pi/2. On the unit sphere a
/// rod v = const has the Darboux frame C' = T, T' = -C + g N, N' = -g T with N = C x T and geodesic
/// curvature g = -v f'(uv), from C = (0, sin v, cos v), T = (1, 0, 0). Both are integrated by
/// Taylor series (one step covers the hemisphere), to machine accuracy.
class SphereNet final : public ChebyshevNet {
 public:
  /// uv/rho^2 at which the net folds: the zero of f. At minus this value f reaches pi.
  static constexpr double fold = 1.8615916773;

  explicit SphereNet(double radius_mm) : radius_(radius_mm) {}
  double radius() const { return radius_; }
  Result<NetPoint> at(double u, double v) const override;

  /// f(z): shear angle at uv = z rho^2, also past the fold.
  static double shear(double z);

 private:
  double radius_;
};

/// Translation net C(u, v) = X(u) + Y(v): the sum of two unit-speed curves is a Chebyshev net with
/// C_uv = 0. u = v = 0 is at the middles of the curves; the net is not moved to the origin.
class TranslationNet final : public ChebyshevNet {
 public:
  /// `x` and `y`: points of the two curves, 3 x n, mm. Errors (bad_input): those of
  /// SplineCurve::through with the curve's name; a fold anywhere on the net, where the curves
  /// become parallel.
  static Result<TranslationNet> make(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& y);

  double half_u() const { return x_.half_length(); }  ///< the net exists for |u| <= half_u ...
  double half_v() const { return y_.half_length(); }  ///< ... and |v| <= half_v
  Result<NetPoint> at(double u, double v) const override;

 private:
  TranslationNet(UnitSpeedCurve x, UnitSpeedCurve y) : x_(std::move(x)), y_(std::move(y)) {}
  Result<void> check_open() const;
  UnitSpeedCurve x_, y_;
};

}  // namespace gridshell
