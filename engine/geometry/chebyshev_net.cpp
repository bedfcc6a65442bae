#include "engine/geometry/chebyshev_net.h"

#include <Eigen/Geometry>

namespace gridshell {

Eigen::Vector3d NetPoint::normal() const { return tangent_u.cross(tangent_v).normalized(); }

Result<Eigen::Matrix3Xd> points_on(const ChebyshevNet& net, const Eigen::Matrix2Xd& uv) {
  Eigen::Matrix3Xd points(3, uv.cols());
  for (Eigen::Index k = 0; k < uv.cols(); ++k) {
    const auto point = net.at(uv(0, k), uv(1, k));
    if (!point) return tl::unexpected(point.error());
    points.col(k) = point->position;
  }
  return points;
}

}  // namespace gridshell
