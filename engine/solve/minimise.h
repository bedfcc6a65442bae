// Down the energy to a minimum from far away, where full Newton steps lead elsewhere.
#pragma once

#include "engine/core/watch.h"
#include "engine/solve/newton.h"

namespace gridshell {

struct MinimiseOptions {
  double tolerance_mm = 1e-5;
  int most_iterations = 400;
  double EA_scale = 1;  ///< rods made softer: a way to a state near that of rods as they are
  /// From a state that no state is near to: what made the matrix positive definite is remembered
  /// from step to step. Four times as fast there, but long steps may leave the valley they began
  /// in, which a seed or a branch has chosen.
  bool rough = false;
};

/// Newton's corrections of the mixed form with a line search: the energy falls at every step, and
/// the end is a minimum, never a saddle. Where the matrix is not positive definite its compressive
/// axial forces are weakened until it is (they alone make nearly straight rods lose stability), and
/// only where that is not enough it is shifted. A step that would stretch the rods is followed by
/// one that gives them their lengths back, so that soft modes may go far. At a saddle where nothing
/// moves the outcome is not_converged; settle() leads on. `state.force` is where
/// the mixed form starts (zero serves), and is set at the end. Outcomes: reached, not_converged,
/// not_finite, cancelled.
NewtonReport minimise(Linearisation& system, State& state, const MinimiseOptions& options,
                      const Watch& watch);

}  // namespace gridshell
