// How far a gridshell lies from the net it was designed on.
#pragma once

#include <Eigen/Core>

namespace gridshell {

/// Delta/rho of the joints [Baek 2018, Fig. 3]: distance between each joint and its place on the
/// net, over the length scale rho.
class Deviation {
 public:
  /// `joints`, `net`: 3 x n in the same order and frame; rho in the same unit.
  Deviation(const Eigen::Matrix3Xd& joints, const Eigen::Matrix3Xd& net, double rho);

  const Eigen::VectorXd& of_joints() const { return of_joints_; }
  double largest() const;
  double mean() const;
  /// The value that a fraction q in [0, 1] of the joints does not exceed, linear between order
  /// statistics: quantile(0) is the least, quantile(0.5) the median, quantile(1) the largest.
  double quantile(double q) const;

 private:
  Eigen::VectorXd of_joints_, sorted_;
};

}  // namespace gridshell
