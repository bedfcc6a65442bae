// Chebyshev nets: surfaces C(u, v) whose parameter lines are both parametrised by arc length,
// |C_u| = |C_v| = 1, so that a square grid of inextensible rods lies on them [Baek 2018, eq. 1-2].
#pragma once

#include <Eigen/Core>

#include "engine/core/result.h"

namespace gridshell {

/// A net at one (u, v).
struct NetPoint {
  Eigen::Vector3d position;   ///< C, mm
  Eigen::Vector3d tangent_u;  ///< C_u, unit
  Eigen::Vector3d tangent_v;  ///< C_v, unit
  double omega = 0;           ///< shear angle between C_u and C_v, rad, in (0, pi)
  double K = 0;               ///< Gauss curvature, mm^-2; Gauss' equation: omega_uv = -K sin omega

  /// C_u x C_v / sin omega, unit
  Eigen::Vector3d normal() const;
};

/// A smooth Chebyshev net in a frame of its own, z up; u, v and positions in mm.
class ChebyshevNet {
 public:
  virtual ~ChebyshevNet() = default;

  /// The net at (u, v). Errors (bad_input): where the net folds (omega reaches 0 or pi) or its
  /// surface ends, with the place where it does and the (u, v) asked for.
  virtual Result<NetPoint> at(double u, double v) const = 0;
};

/// C at every column of `uv`. Errors (bad_input): those of the net.
Result<Eigen::Matrix3Xd> points_on(const ChebyshevNet& net, const Eigen::Matrix2Xd& uv);

}  // namespace gridshell
