// How an equilibrium is found from a state that is not one: by descent of the energy, slowly or by
// Newton's method, and away from saddles.
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

/// How an unstable state is left.
struct BranchSwitch {
  /// Start vector over all columns; its projection on the lowest modes is followed; empty: any.
  Eigen::Matrix3Xd start;
  BranchSide side = BranchSide::lower;
  double amplitude_mm = 0.5;  ///< of the push: far above round-off, far below a cell
  double step_mm = 0.5;       ///< step of the descent, gradient_flow()
  /// Symmetries of the mesh. If one maps one side of the saddle to the other, only one descent is
  /// computed.
  std::vector<MeshSymmetry> symmetries = {};
};

/// A direction with a part along any mode: no symmetry of a net leaves it unchanged. Columns are at
/// most as long as one.
Eigen::Matrix3Xd generic_direction(Eigen::Index columns);

/// Lowest mode of the Hessian last assembled in `system`, by inverse iteration from `start` (empty:
/// any): a unit vector over all columns, zero at constrained components. Its sign, and the
/// combination of several modes of equal eigenvalue, are those of the projection of `start`.
Eigen::Matrix3Xd softest_mode(Linearisation& system, const Eigen::Matrix3Xd& start,
                              const Watch& watch);

/// Finds an equilibrium near `state`: by full Newton steps that displace no node by more than
/// `farthest_mm` and end in a minimum; else by minimising the energy; else from a saddle along its
/// lowest mode. Errors: no_equilibrium with the methods that were tried, cancelled.
Result<State> find_equilibrium(Linearisation& system, const State& state, double farthest_mm,
                               const Watch& watch);

/// Minimises the energy; from a saddle it continues along the lowest mode. Errors as
/// find_equilibrium().
Result<State> minimise_from(Linearisation& system, State state, const Watch& watch,
                            const BranchSwitch& departure = {});

/// Perturbs an unstable state along `mode` (its lowest) to either side and follows the steepest
/// descent to an equilibrium. Returns the one of lower energy, or the one on the requested side.
/// Only one side is computed if the other leads to the same state or its mirror image. A
/// perturbation that leads back to the saddle is repeated four times as large, up to 1 mm. Errors:
/// no_equilibrium, cancelled.
Result<State> leave_saddle(Linearisation& system, const State& unstable,
                           const Eigen::Matrix3Xd& mode, const BranchSwitch& departure,
                           const Watch& watch);

}  // namespace gridshell
