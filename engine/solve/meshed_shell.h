// A shell on one mesh: its model, how its ends move, and what is solved with.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/footprint/boundary_motion.h"
#include "engine/gridshell/shell_rods.h"
#include "engine/solve/motion.h"

namespace gridshell {

/// Stays where it was made: `system` refers to `model`.
struct MeshedShell {
  RodMesh mesh;
  Model model;
  PinnedMotion motion;
  std::unique_ptr<Linearisation> system;

  /// Fills it, for a mesh of so many edges a segment. Errors (bad_input): rods that the rung cannot
  /// take.
  Result<void> build(const Footprint& footprint, const ShellRods& rods, Mechanics rung,
                     const BoundaryMotion& boundary, int edges_per_segment);
};

}  // namespace gridshell
