// How near two straight pieces come to each other.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace gridshell {

/// The nearest points of the segments p + s (q - p) and a + t (b - a), s and t in [0, 1], and the
/// square of their distance [Ericson 2004, 5.1.9]. Of parallel ones, one of the nearest pairs.
struct NearestPoints {
  double s = 0, t = 0, distance2 = 0;
};

inline NearestPoints nearest_points(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                                    const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d d = q - p, e = b - a, r = p - a;
  const double dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e);
  const double dr = d.dot(r), er = e.dot(r);
  const auto within = [](double above, double below) {
    return below > 0 ? std::clamp(above / below, 0.0, 1.0) : 0.0;
  };
  NearestPoints near;
  // where the lines are nearest, or of parallel ones the begin
  const double across = dd * ee - de * de;
  near.s = across > 1e-14 * dd * ee ? within(de * er - dr * ee, across) : 0;
  near.t = within(de * near.s + er, ee);
  near.s = within(de * near.t - dr, dd);
  near.distance2 = (r + near.s * d - near.t * e).squaredNorm();
  return near;
}

}  // namespace gridshell
