// A footprint inside a closed curve that a user gives, and the curve its boundary moves to.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "engine/core/result.h"
#include "engine/footprint/footprint.h"
#include "engine/geometry/closed_curve.h"
#include "engine/preset/preset.h"
#include "engine/scene/scene.h"

namespace gridshell {

struct CurveDesign {
  std::unique_ptr<Domain> domain;
  BoundaryMap map;
  double scale_mm = 0;  ///< half the diagonal of the box around the original boundary

  /// Where points of the original boundary are moved to, 2 x n.
  Eigen::Matrix2Xd actuated(const Eigen::Matrix2Xd& on_original) const;
};

/// The original and the actuated boundary of a preset, and the map between them. Errors
/// (bad_input): those of the curves and of the map.
Result<CurveDesign> curve_design(const preset::Preset& preset);

/// The end condition that a name denotes.
RodEnd rod_end_of(preset::EndKind kind);

// A footprint from a file of rods, their supports and the prescribed displacement of the supports.

/// Fills footprint, frame, motion and boundaries of a scene from `[footprint] file`. The origin of
/// the flat frame is the middle of the rods' bounding box. Supports move to the positions in the
/// file; other ends to `[actuation] scale` times their position relative to the middle (0: they do
/// not move). Boundaries are the convex hull of the constrained points. Errors (bad_input): those
/// of network_footprint().
Result<void> build_network(const preset::Preset& preset, Scene& scene);

}  // namespace gridshell
