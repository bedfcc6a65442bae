// How a shell comes to rest: down the energy, slowly or by Newton's steps, and off a state that is
// not stable.
#pragma once

#include <functional>

#include "engine/core/choices.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/footprint/symmetry.h"
#include "engine/solve/newton.h"

namespace gridshell {

// Down the energy slowly, along its steepest slope. Where that ends does not depend on the mesh;
// where long steps end does.

/// As a shell without mass in a viscous fluid would go: dx/ds = -dE/dx, by linearly implicit Euler
/// steps of the mixed form, (K + m I) dx = -dE/dx, m about as small as keeps every node's move
/// within `step_mm` (a move of up to twice that is cut to it). Ends where Newton's own correction,
/// m = 0, is a tenth of that or less and K is positive definite: near a minimum, which minimise()
/// then finds. `seen` gets the state after every step but the last and ends the flow, as reached,
/// where it says so. `state.force` is where the mixed form starts. Outcomes: reached, not_converged
/// (steps ran out), not_finite, cancelled.
Outcome gradient_flow(Linearisation& system, State& state, double step_mm, const Watch& watch,
                      const std::function<bool(const State&)>& seen = {});

// Down the energy to a minimum from far away, where full Newton steps lead elsewhere.

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
/// moves the outcome is not_converged; leave_saddle() leads on. `state.force` is where
/// the mixed form starts (zero serves), and is set at the end. Outcomes: reached, not_converged,
/// not_finite, lost (rods that touch leave no way down), cancelled.
NewtonReport minimise(Linearisation& system, State& state, const MinimiseOptions& options,
                      const Watch& watch);

// Coming to rest: beside a state that is not stable, and after a path lost its branch.

/// How an unstable state is left.
struct BranchSwitch {
  Eigen::Matrix3Xd start;  ///< over all columns: its part along the softest modes is followed;
                           ///< empty: any
  BranchSide side = BranchSide::lower;
  double amplitude_mm = 0.5;  ///< of the push: far above round-off, far below a cell
  double step_mm = 0.5;       ///< of the way down, gradient_flow()
  /// Of the mesh. Where one of them takes one side to the other, one way down is enough.
  std::vector<MeshSymmetry> symmetries = {};
};

/// A direction with a part along any mode: no symmetry of a net leaves it unchanged. Columns are at
/// most as long as one.
Eigen::Matrix3Xd generic_direction(Eigen::Index columns);

/// Softest mode of the Hessian last assembled in `system` by inverse iteration from `start` (empty:
/// any): unit vector over all columns, zero at what is held. Its side, and the mixture where
/// several modes are equally soft, are those of the start's projection on them.
Eigen::Matrix3Xd softest_mode(Linearisation& system, const Eigen::Matrix3Xd& start,
                              const Watch& watch);

/// From `state` to rest near it: full Newton steps that move no node further than `farthest_mm` and
/// end in a minimum, else down the energy, else off a saddle along its softest mode. Errors:
/// no_equilibrium with what was tried, cancelled.
Result<State> find_equilibrium(Linearisation& system, const State& state, double farthest_mm,
                               const Watch& watch);

/// Down the energy to a minimum; where that ends at a saddle, off it along its softest mode.
/// Errors as find_equilibrium().
Result<State> minimise_from(Linearisation& system, State state, const Watch& watch,
                            const BranchSwitch& departure = {});

/// From a state that is not stable, pushed along `mode` (its softest) to either side, to the rest
/// that the steepest slope leads to; the one of lower energy, or that on the side asked for. One
/// side alone is gone down where the other comes to the same or to its mirror image. A push
/// that leads back to the saddle is repeated four times as large, up to 1 mm. Errors:
/// no_equilibrium, cancelled.
Result<State> leave_saddle(Linearisation& system, const State& unstable,
                           const Eigen::Matrix3Xd& mode, const BranchSwitch& departure,
                           const Watch& watch);

}  // namespace gridshell
