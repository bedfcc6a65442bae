// Coming to rest: beside a state that is not stable, and after a path lost its branch.
#pragma once

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/core/words.h"
#include "engine/footprint/mesh_symmetry.h"
#include "engine/solve/path.h"

namespace gridshell {

/// On which side of an unstable state to leave it: where the energy ends lower, along a mode, or
/// against it.
enum class Leave { lower, along, against };
constexpr auto words(Leave) {
  return word_table<Leave>(
      {{Leave::lower, "lower"}, {Leave::along, "along"}, {Leave::against, "against"}});
}

/// How an unstable state is left.
struct Departure {
  Eigen::Matrix3Xd start;  ///< over all columns: its part along the softest modes is followed;
                           ///< empty: any
  Leave side = Leave::lower;
  double amplitude_mm = 0.5;  ///< of the push: far above round-off, far below a cell
  double step_mm = 0.5;       ///< of the way down (drift.h)
  /// Of the mesh. Where one of them takes one side to the other, one way down is enough.
  std::vector<MeshSymmetry> symmetries = {};
};

/// A direction with a part along any mode: no symmetry of a net leaves it unchanged. Columns are at
/// most as long as one.
Eigen::Matrix3Xd any_direction(Eigen::Index columns);

/// Softest mode of the Hessian last assembled in `system` by inverse iteration from `start` (empty:
/// any): unit vector over all columns, zero at what is held. Its side, and the mixture where
/// several modes are equally soft, are those of the start's projection on them.
Eigen::Matrix3Xd softest_mode(Linearisation& system, const Eigen::Matrix3Xd& start,
                              const Watch& watch);

/// From `state` to rest near it: full Newton steps that move no node further than `farthest_mm` and
/// end in a minimum, else down the energy, else off a saddle along its softest mode. Errors:
/// no_equilibrium with what was tried, cancelled.
Result<State> rest_near(Linearisation& system, const State& state, double farthest_mm,
                        const Watch& watch);

/// Down the energy to a minimum; where that ends at a saddle, off it along its softest mode.
/// Errors as rest_near().
Result<State> rest_below(Linearisation& system, State state, const Watch& watch,
                         const Departure& departure = {});

/// From a state that is not stable, pushed along `mode` (its softest) to either side, to the rest
/// that the steepest slope leads to; the one of lower energy, or that on the side asked for. One
/// side alone is gone down where the other comes to the same or to its mirror image. A push
/// that leads back to the saddle is repeated four times as large, up to 1 mm. Errors:
/// no_equilibrium, cancelled.
Result<State> settle(Linearisation& system, const State& unstable, const Eigen::Matrix3Xd& mode,
                     const Departure& departure, const Watch& watch);

}  // namespace gridshell
