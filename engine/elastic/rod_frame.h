// Reference frames of edges, carried in time by parallel transport [Bergou 2010].
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace gridshell {

/// `v` rotated about a x b by the rotation that takes unit tangent a to unit tangent b (parallel
/// transport). Undefined at b = -a.
inline Eigen::Vector3d transport(const Eigen::Vector3d& v, const Eigen::Vector3d& a,
                                 const Eigen::Vector3d& b) {
  const double c = a.dot(b);
  const Eigen::Vector3d axis = a.cross(b);
  return c * v + axis.cross(v) + axis.dot(v) / (1 + c) * axis;
}

/// `director` transported from tangent a to b, and made a unit normal of b so that round-off cannot
/// grow.
inline Eigen::Vector3d carried_director(const Eigen::Vector3d& director, const Eigen::Vector3d& a,
                                        const Eigen::Vector3d& b) {
  const Eigen::Vector3d d = transport(director, a, b);
  return (d - d.dot(b) * b).normalized();
}

/// The unit normal of tangent t that is nearest to `request`; any normal if `request` is along t.
inline Eigen::Vector3d normal_near(const Eigen::Vector3d& request, const Eigen::Vector3d& t) {
  const Eigen::Vector3d d = request - request.dot(t) * t;
  return d.norm() > 1e-6 * request.norm() ? d.normalized() : t.unitOrthogonal();
}

/// Angle from unit vector a to b about `axis` (unit, normal to both), in (-pi, pi].
inline double signed_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           const Eigen::Vector3d& axis) {
  return std::atan2(axis.dot(a.cross(b)), a.dot(b));
}

/// The value of `angle` + 2 pi n nearest to `before`, so that angles above a full turn do not jump.
inline double unwrapped(double angle, double before) {
  return angle + 2 * M_PI * std::round((before - angle) / (2 * M_PI));
}

/// m_ref: the angle from e's reference director, transported in space to f's tangent, to f's.
inline double reference_twist(const Eigen::Vector3d& director_e, const Eigen::Vector3d& tangent_e,
                              const Eigen::Vector3d& director_f, const Eigen::Vector3d& tangent_f) {
  return signed_angle(transport(director_e, tangent_e, tangent_f), director_f, tangent_f);
}

}  // namespace gridshell
