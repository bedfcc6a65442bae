// Profiles of surfaces of revolution.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace gridshell {

/// Radius r(t) > 0 and height z(t) along the axis, mm, by derivatives with respect to t.
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
  double origin = 0;           ///< t of the net's middle, u = v = 0
  double axial_origin = 0;     ///< z there, mm
};

/// r = R, |z| <= half_length. Errors (bad_input): R or half_length not positive.
Result<Profile> cylinder_profile(double radius_mm, double half_length_mm);

/// K = -1/rho^2, spool type: r = rho a cosh(s/rho), z' = sqrt(1 - a^2 sinh^2(s/rho)), up to the
/// rims sinh(s/rho) = 1/a. `waist` is a = smallest radius over rho; the waist is the middle. With
/// a sinh(s/rho) = sin t this is smooth up to the rims: r = rho sqrt(a^2 + sin^2 t).
/// Errors (bad_input): rho or a not positive.
Result<Profile> spool_profile(double radius_mm, double waist);

/// Beltrami's pseudosphere, K = -1/rho^2: r = rho sech t, z = rho (t - tanh t), from its rim t = 0
/// on, growing thinner with z; `waist` = r/rho at the middle of the net. Errors (bad_input): rho
/// not positive, waist not in (0, 1).
Result<Profile> beltrami_profile(double radius_mm, double waist);

/// A spline through (r, z) points, 2 x n, in order along the profile; the middle is that of its arc
/// length. Errors (bad_input): those of SplineCurve::through, r <= 0 (also between the points).
Result<Profile> tabulated_profile(const Eigen::Matrix2Xd& r_z);

}  // namespace gridshell
