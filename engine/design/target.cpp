#include "engine/design/target.h"

#include <Eigen/LU>

#include "engine/scene/net_design.h"

namespace gridshell {

Result<DesignTarget> DesignTarget::make(std::shared_ptr<const ChebyshevNet> net,
                                        Eigen::Matrix2Xd uv, preset::Target kind) {
  auto places = points_on(*net, uv);
  if (!places) return tl::unexpected<Error>(places.error());
  DesignTarget target;
  target.net_ = std::move(net);
  target.kind_ = kind;
  target.uv_ = std::move(uv);
  target.places_ = std::move(*places);
  return target;
}

Distances DesignTarget::distances(const Eigen::Matrix3Xd& joints) {
  if (kind_ == preset::Target::net) return {joints - places_, {}};
  constexpr int most_iterations = 30;
  constexpr double near_mm = 1e-10;
  Distances found{Eigen::Matrix3Xd(3, joints.cols()), Eigen::Matrix3Xd(3, joints.cols())};
  for (Eigen::Index k = 0; k < joints.cols(); ++k) {
    const Eigen::Vector3d joint = joints.col(k);
    auto at = net_->at(uv_(0, k), uv_(1, k));
    // where it was found last there is a net
    for (int iteration = 0; at && iteration < most_iterations; ++iteration) {
      const Eigen::Vector3d off = joint - at->position;
      const double c = at->tangent_u.dot(at->tangent_v);
      Eigen::Matrix2d metric;
      metric << 1, c, c, 1;
      const Eigen::Vector2d step =
          metric.inverse() * Eigen::Vector2d(off.dot(at->tangent_u), off.dot(at->tangent_v));
      const Eigen::Vector2d there = uv_.col(k) + step;
      const auto next = net_->at(there.x(), there.y());
      if (!next) break;
      uv_.col(k) = there;
      at = next;
      if (step.norm() < near_mm) break;
    }
    const Eigen::Vector3d normal = at->normal();
    found.normal.col(k) = normal;
    found.vector.col(k) = normal.dot(joint - at->position) * normal;
  }
  return found;
}

}  // namespace gridshell
