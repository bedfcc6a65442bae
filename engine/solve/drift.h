// Down the energy slowly, along its steepest slope. Where that ends does not depend on the mesh;
// where long steps end does.
#pragma once

#include "engine/core/watch.h"
#include "engine/solve/newton.h"

namespace gridshell {

/// As a shell without mass in a viscous fluid would go: dx/ds = -dE/dx, by linearly implicit Euler
/// steps of the mixed form, (K + m I) dx = -dE/dx, m about as small as keeps every node's move
/// within `step_mm` (a move of up to twice that is cut to it). Ends where Newton's own correction,
/// m = 0, is a tenth of that or less and K is positive definite: near a minimum, which minimise()
/// then finds. `state.force` is where the mixed form starts. Outcomes: reached, not_converged
/// (steps ran out), not_finite, cancelled.
Outcome drift(Linearisation& system, State& state, double step_mm, const Watch& watch);

}  // namespace gridshell
