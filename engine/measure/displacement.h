// How far a push at one joint is felt.
#pragma once

#include <Eigen/Core>

namespace gridshell {

/// The reach of a displacement field |u|/depth over the joints [Baek 2018, Fig. 4C].
struct Reach {
  double above_tenth = 0;  ///< share of the joints with |u|/depth > 0.1
  double above_half = 0;   ///< share of the joints with |u|/depth > 0.5
  /// of the joints above 0.1 the lowest, by the place before the push, as seen from the origin:
  /// asin(z/|x|), degrees
  double lowest_latitude_deg = 0;
};

/// `before`, `now`: 3 x joints, mm; `depth`: of the push, mm. All NaN at depth 0.
Reach reach_of(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& now, double depth);

}  // namespace gridshell
