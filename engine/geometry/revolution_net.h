// Chebyshev nets on surfaces of revolution, and the profiles of these surfaces.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/geometry/calculus.h"
#include "engine/geometry/chebyshev_net.h"

namespace gridshell {

/// Radius r(t) > 0, mm, and its derivatives with respect to t; derivatives of the height z(t) along
/// the axis.
struct ProfilePoint {
  double r = 0, dr = 0, ddr = 0;
  double dz = 0, ddz = 0;

  double speed() const;  ///< ds/dt = sqrt(dr^2 + dz^2)
  double K() const;      ///< Gauss curvature of the surface, z' (z'' r' - r'' z') / (r s'^4)
};

/// A profile (z(t), r(t)) with any parameter t, smooth between `breaks`.
struct Profile {
  std::string name;  ///< "cylinder of radius 40 mm", for messages
  std::function<ProfilePoint(double)> at;
  std::vector<double> breaks;  ///< ascending; first and last are the ends of the profile
  double origin = 0;           ///< t at the net's middle, u = v = 0
  double axial_origin = 0;     ///< z at the net's middle, mm
};

/// A cylinder, r = R, |z| <= half_length. Errors (bad_input): R or half_length not positive.
Result<Profile> cylinder_profile(double radius_mm, double half_length_mm);

/// The surface of Gauss curvature K = -1/rho^2 of spool type: r = rho a cosh(s/rho), z' = sqrt(1 -
/// a^2 sinh^2(s/rho)), up to the rims sinh(s/rho) = 1/a. `waist` is a = smallest radius over rho;
/// the waist is the middle. With a sinh(s/rho) = sin t it is smooth up to the rims: r = rho
/// sqrt(a^2 + sin^2 t). Errors (bad_input): rho or a not positive.
Result<Profile> spool_profile(double radius_mm, double waist);

/// Beltrami's pseudosphere, K = -1/rho^2: r = rho sech t, z = rho (t - tanh t), t >= 0, with its
/// rim at t = 0. `waist` is r/rho at the middle of the net. Errors (bad_input): rho not positive,
/// waist not in (0, 1).
Result<Profile> beltrami_profile(double radius_mm, double waist);

/// A spline through points (r, z), 2 x n, in order along the profile; the net's middle is the
/// middle of its arc length. Errors (bad_input): those of SplineCurve::through; a point with r <=
/// 0.
Result<Profile> tabulated_profile(const Eigen::Matrix2Xd& r_z);

/// Chebyshev net on a surface of revolution [Baek 2018, SI S2]. With x = u + v along the profile
/// and y = u - v around the axis, phi = c y and ds/dx = sqrt(1 - c^2 r^2), where s is the profile's
/// arc length. Then C_x and C_y are orthogonal, of lengths cos(omega/2) and sin(omega/2),
/// sin(omega/2) = c r, and |C_u| = |C_v| = 1.
///
/// The axis is the world's x: C = (z, -r sin phi, r cos phi), so that phi = 0 is on top, where C_u
/// x C_v points outwards. The profile's middle is at u = v = 0.
class RevolutionNet final : public ChebyshevNet {
 public:
  /// `c` in 1/mm. Errors (bad_input): c not positive; c r >= 1 in the middle, where no net exists.
  static Result<RevolutionNet> make(Profile profile, double c);

  Result<NetPoint> at(double u, double v) const override;

  double c() const { return c_; }
  double first_x() const { return (*x_)(x_->begin()); }  ///< least u + v at which the net exists
  double last_x() const { return (*x_)(x_->end()); }     ///< largest u + v at which it exists

  /// u + v at the axial distance `z` from the net's middle, for profiles whose height grows. Errors
  /// (bad_input): the net folds or the profile ends before.
  Result<double> x_at_axial(double z) const;

 private:
  /// The reason why the net ends at an end of its range, as text.
  std::string why_it_ends(bool last) const;

  Profile profile_;
  double c_ = 0;
  std::shared_ptr<const Antiderivative> x_, z_;  ///< u + v, and height along the axis, over t
};

}  // namespace gridshell
