// The boundary on its way.
#pragma once

#include <cmath>

#include "engine/record/snapshot.h"

namespace gridshell::render {

/// Every point moves straight and evenly from the original (actuation 0) to the actuated boundary
/// (1). 3 x n, mm.
inline Eigen::Matrix3Xd boundary_at(const record::Layout& layout, double actuation) {
  return layout.original_boundary +
         actuation * (layout.actuated_boundary - layout.original_boundary);
}

/// Whether the original boundary says anything: not where an actuated shell is pushed.
inline bool shows_original(const record::Frame& frame) { return !std::isfinite(frame.depth_mm); }

}  // namespace gridshell::render
