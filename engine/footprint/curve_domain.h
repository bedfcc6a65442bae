// The inside of a closed curve that a user gives.
#pragma once

#include "engine/footprint/domain.h"
#include "engine/geometry/closed_curve.h"

namespace gridshell {

/// Grid lines are cut where they cross the curve; a curve with hollows cuts a line more than once.
class CurveDomain final : public Domain {
 public:
  explicit CurveDomain(ClosedCurve curve);
  std::vector<Interval> intervals(Family family, double c) const override;
  /// evenly by arc length between corners, all corners among them where `points` allows
  Eigen::Matrix2Xd boundary(int points) const override;
  double reach() const override { return reach_; }

 private:
  ClosedCurve curve_;
  double reach_ = 0;
};

}  // namespace gridshell
