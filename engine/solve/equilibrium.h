// Finds an equilibrium from a state that is not one: by gradient flow, by minimising the energy
// with Newton's method, and by descent from saddles.
#pragma once

#include <functional>

#include "engine/core/choices.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/footprint/symmetry.h"
#include "engine/solve/newton.h"

namespace gridshell {

// Steepest descent of the energy in small steps. The equilibrium that it reaches does not depend on
// the mesh; that of long steps does.

/// Moves the state like a shell without mass in a viscous fluid, dx/ds = -dE/dx, by linearly
/// implicit Euler steps of the mixed form, (K + m I) dx = -dE/dx. The shift m is about the smallest
/// with which no node moves further than `step_mm` (a move of up to twice that is cut to it). Ends
/// where Newton's correction (m = 0) is at most a tenth of `step_mm` and K is positive definite:
/// near a minimum, which minimise() then finds. `seen` is called with the state after every step
/// but the last; if it returns true, the flow ends with outcome reached. `state.force` is the start
/// of the mixed form. Outcomes: reached, not_converged (after 1000 steps), not_finite, cancelled.
Outcome gradient_flow(Linearisation& system, State& state, double step_mm, const Watch& watch,
                      const std::function<bool(const State&)>& seen = {});

// Minimisation of the energy from far away, where full Newton steps would lead to another state.

struct MinimiseOptions {
  double tolerance_mm = 1e-5;
  int most_iterations = 400;
  /// factor of EA; a softer rod leads to a state near that of the actual rods
  double EA_scale = 1;
  /// For states far from any equilibrium: the shift that made the matrix positive definite is
  /// reused in the next step. This is four times as fast there, but long steps may leave the basin
  /// of attraction that a seed or a branch has chosen.
  bool rough = false;
};

/// Newton's method for the mixed form with a line search. The energy decreases at every step, and
/// the result is a minimum, never a saddle. Where the matrix is not positive definite, compressive
/// axial forces are reduced until it is (they alone destabilise nearly straight rods); if that is
/// not enough, the matrix is shifted. A step that would stretch the rods is followed by one that
/// restores their lengths, so that displacements along low modes may be large. At a saddle without
/// a descent direction the outcome is not_converged; leave_saddle() continues from there.
/// `state.force` is the start of the mixed form (zero is enough) and is set at the end. Outcomes:
/// reached, not_converged, not_finite, lost (contact leaves no descent direction), cancelled.
NewtonReport minimise(Linearisation& system, State& state, const MinimiseOptions& options,
                      const Watch& watch);

// Search for an equilibrium near an unstable state, or after a path lost its branch.

/// How the descent from an unstable state is chosen.
struct BranchSwitch {
  /// Start vector of softest_mode(), 3 x columns; empty: generic_direction().
  Eigen::Matrix3Xd start;
  BranchSide side = BranchSide::lower;
  double amplitude_mm = 0.5;  ///< perturbation: far above round-off, far below the size of a cell
  double step_mm = 0.5;       ///< step of the descent, gradient_flow()
  /// Symmetries of the mesh. If one maps one side of the saddle to the other, only one descent is
  /// computed.
  std::vector<MeshSymmetry> symmetries = {};
};

/// A direction, 3 x columns, with a component along every mode: no symmetry of a net leaves it
/// unchanged. The norm of each column is at most 1.
Eigen::Matrix3Xd generic_direction(Eigen::Index columns);

/// Lowest mode of the Hessian last assembled in `system`, by inverse iteration from `start` (empty:
/// generic_direction()): a unit vector, 3 x columns, zero at constrained components. Its sign, and
/// the combination of several modes of equal eigenvalue, are those of the projection of `start`.
Eigen::Matrix3Xd softest_mode(Linearisation& system, const Eigen::Matrix3Xd& start,
                              const Watch& watch);

/// Finds an equilibrium near `state`: by full Newton steps that displace no node by more than
/// `farthest_mm` and end in a minimum; if they end in a saddle, along its lowest mode to the side
/// of `departure`, if that chooses one (its `start` is not empty); else by minimising the energy;
/// else from a saddle along its lowest mode. Errors: no_equilibrium with the methods that were
/// tried, cancelled.
Result<State> find_equilibrium(Linearisation& system, const State& state, double farthest_mm,
                               const Watch& watch, const BranchSwitch& departure = {});

/// Minimises the energy; from a saddle it continues along the lowest mode. Errors as
/// find_equilibrium().
Result<State> minimise_from(Linearisation& system, State state, const Watch& watch,
                            const BranchSwitch& departure = {});

/// Perturbs an unstable state along `mode` (its lowest) to either side and follows the steepest
/// descent to an equilibrium. Returns the one of lower energy, or the one on the requested side.
/// Only one side is computed if the other leads to the same state or its mirror image. A
/// perturbation that leads back to the saddle is repeated four times as large, up to twice the step
/// of the descent. Errors: no_equilibrium, cancelled.
Result<State> leave_saddle(Linearisation& system, const State& unstable,
                           const Eigen::Matrix3Xd& mode, const BranchSwitch& departure,
                           const Watch& watch);

}  // namespace gridshell
