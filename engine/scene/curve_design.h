// A footprint inside a closed curve that a user gives, and the curve its boundary moves to.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "engine/core/result.h"
#include "engine/footprint/domain.h"
#include "engine/geometry/closed_curve.h"
#include "engine/preset/preset.h"

namespace gridshell {

struct CurveDesign {
  std::unique_ptr<Domain> domain;
  BoundaryMap map;
  double scale_mm = 0;  ///< half the diagonal of the box around the original boundary

  /// Where points of the original boundary are moved to, 2 x n.
  Eigen::Matrix2Xd actuated(const Eigen::Matrix2Xd& on_original) const;
};

/// Errors (bad_input): those of the curves and of the map between them, saying which.
Result<CurveDesign> curve_design(const preset::Preset& preset);

}  // namespace gridshell
