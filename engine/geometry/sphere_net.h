// Chebyshev's net on the sphere, from two orthogonal great circles through the pole.
#pragma once

#include "engine/geometry/chebyshev_net.h"

namespace gridshell {

/// Centre at the origin, pole (u = v = 0) at +z, u-axis in the xz-plane; radius rho.
///
/// The shear angle is omega = f(uv/rho^2), f' + z f'' = -sin f, f(0) = pi/2. On the unit sphere a
/// rod v = const has the Darboux frame C' = T, T' = -C + g N, N' = -g T with N = C x T and geodesic
/// curvature g = -v f'(uv), from C = (0, sin v, cos v), T = (1, 0, 0). Both are integrated by
/// Taylor series (one step covers the hemisphere), to machine accuracy.
class SphereNet final : public ChebyshevNet {
 public:
  /// uv/rho^2 at which the net folds: the zero of f. -uv/rho^2 there is where f reaches pi.
  static constexpr double fold = 1.8615916773;

  explicit SphereNet(double radius_mm) : radius_(radius_mm) {}
  double radius() const { return radius_; }
  Result<NetPoint> at(double u, double v) const override;

  /// f(z): shear angle at uv = z rho^2, also beyond the fold.
  static double shear(double z);

 private:
  double radius_;
};

}  // namespace gridshell
