// How far a gridshell lies from the net it was designed on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/footprint/mesh.h"

namespace gridshell {

/// Delta/rho of the joints [Baek 2018, Fig. 3]: distance between each joint and its place on the
/// net, over the length scale rho.
class NetDeviation {
 public:
  /// `joints`, `net`: 3 x n in the same order and frame; rho in the same unit.
  NetDeviation(const Eigen::Matrix3Xd& joints, const Eigen::Matrix3Xd& net, double rho);

  const Eigen::VectorXd& of_joints() const { return of_joints_; }
  double largest() const;
  double mean() const;
  /// The value that a fraction q in [0, 1] of the joints does not exceed, linear between order
  /// statistics: quantile(0) is the least, quantile(0.5) the median, quantile(1) the largest.
  double quantile(double q) const;

 private:
  Eigen::VectorXd of_joints_, sorted_;
};

// How far a push at one joint is felt.

/// The reach of a displacement field |u|/depth over the joints [Baek 2018, Fig. 4C].
struct PushReach {
  double above_tenth = 0;  ///< share of the joints with |u|/depth > 0.1
  double above_half = 0;   ///< share of the joints with |u|/depth > 0.5
  /// of the joints above 0.1 the lowest, by the place before the push, as seen from the origin:
  /// asin(z/|x|), degrees
  double lowest_latitude_deg = 0;
};

/// `before`, `now`: 3 x joints, mm; `depth`: of the push, mm. All NaN at depth 0.
PushReach push_reach(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& now, double depth);

// By which mode rods buckled.

/// Inflections of every rod of a mesh whose nodes lie at `x` (3 x nodes, mm): how often its
/// curvature vector comes back on the other side, that is, with a negative product with the one
/// before. Curvatures below a twentieth of the rod's largest are not looked at. 0: buckled by the
/// first mode.
std::vector<int> inflections(const RodMesh& mesh, const Eigen::Matrix3Xd& x);

}  // namespace gridshell
