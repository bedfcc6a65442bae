// What a design aims at, and how far the joints are from it.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "engine/preset/preset.h"
#include "engine/scene/scene.h"

namespace gridshell {

/// The distance of each joint from the target as a vector in space, 3 x joints, mm, and the part of
/// a joint's move that changes it: all of the move where the joint's own place on the net is the
/// target, that along the surface's normal where the surface is.
struct Distances {
  Eigen::Matrix3Xd vector;
  Eigen::Matrix3Xd normal;  ///< unit; empty: every move counts

  Eigen::VectorXd size() const { return vector.colwise().norm(); }
};

class DesignTarget {
 public:
  /// For points that belong at (u, v) of a net. Errors: those of the net there.
  static Result<DesignTarget> make(std::shared_ptr<const ChebyshevNet> net, Eigen::Matrix2Xd uv,
                                   preset::Target kind);

  /// From the surface the nearest point is found by Newton's method on the net, from where it was
  /// found last; where the net ends before, its tangent plane takes the surface's place.
  Distances distances(const Eigen::Matrix3Xd& joints);
  /// The nearest points themselves, 3 x joints.
  Eigen::Matrix3Xd nearest(const Eigen::Matrix3Xd& joints) {
    return joints - distances(joints).vector;
  }

 private:
  std::shared_ptr<const ChebyshevNet> net_;
  preset::Target kind_ = preset::Target::surface;
  Eigen::Matrix2Xd uv_;      // of the nearest points
  Eigen::Matrix3Xd places_;  // of the joints on the net
};

}  // namespace gridshell
