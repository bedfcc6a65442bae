// Chebyshev nets on surfaces of revolution [Baek 2018, SI S2].
#pragma once

#include <memory>

#include "engine/geometry/antiderivative.h"
#include "engine/geometry/chebyshev_net.h"
#include "engine/geometry/profile.h"

namespace gridshell {

/// With x = u + v along the profile and y = u - v around the axis: phi = c y and
/// ds/dx = sqrt(1 - c^2 r^2), s the profile's arc length. Then C_x and C_y are orthogonal, of
/// lengths cos(omega/2) and sin(omega/2), sin(omega/2) = c r, and |C_u| = |C_v| = 1.
///
/// The axis is the world's x; C = (z, -r sin phi, r cos phi), so that phi = 0 is on top and
/// C_u x C_v points outwards there. The profile's middle lies at u = v = 0.
class RevolutionNet final : public ChebyshevNet {
 public:
  /// `c` in 1/mm. Errors (bad_input): c not positive; c r >= 1 in the middle, where no net exists.
  static Result<RevolutionNet> make(Profile profile, double c);

  /// c of the net whose rods cross at right angles in the middle: 1/(sqrt(2) r). On a cylinder
  /// these are helices, omega = pi/2 everywhere.
  static double right_angled(const Profile& profile);

  Result<NetPoint> at(double u, double v) const override;

  double c() const { return c_; }
  double first_x() const { return (*x_)(x_->begin()); }  ///< range of u + v in which the net exists
  double last_x() const { return (*x_)(x_->end()); }

  /// u + v at the axial distance `z` from the net's middle. Errors (bad_input): the net folds or
  /// the profile ends before; the profile turns back along its axis.
  Result<double> x_at_axial(double z) const;

 private:
  /// why there is no net beyond an end of its range, in words
  std::string why_it_ends(bool last) const;

  Profile profile_;
  double c_ = 0;
  std::shared_ptr<const Antiderivative> x_, z_;  ///< u + v, and height along the axis, over t
};

}  // namespace gridshell
