#include "engine/solve/drift.h"

#include <algorithm>
#include <cmath>

namespace gridshell {
namespace {

constexpr int most_steps = 1000;
constexpr double smallest_shift = 1e-9, largest_shift = 1e8;  // N/mm

/// Factorises at the state with the smallest shift, from `shift` on, that keeps the move within a
/// step; the shift that served, or a negative one where none does.
double bounded_correction(Linearisation& system, const State& state, double step_mm, double shift,
                          Eigen::Matrix3Xd& dx, const Watch& watch) {
  Inertia inertia = system.at(state, true, shift);
  for (;;) {
    if (inertia.positive_definite()) {
      system.correction(dx);
      const double move = largest_column(dx);
      if (!std::isfinite(move)) return -1;
      if (move <= step_mm) return shift;
    }
    shift = std::max(2 * shift, smallest_shift);
    if (shift > largest_shift || watch.cancelled()) return -1;
    inertia = system.shifted(shift);
  }
}

}  // namespace

Outcome drift(Linearisation& system, State& state, double step_mm, const Watch& watch) {
  double shift = 0;
  Eigen::Matrix3Xd dx;
  for (int step = 0; step < most_steps; ++step) {
    if (watch.cancelled()) return Outcome::cancelled;
    const double served = bounded_correction(system, state, step_mm, shift, dx, watch);
    if (served < 0) return watch.cancelled() ? Outcome::cancelled : Outcome::not_finite;
    ++system.effort().newton_iterations;
    system.apply(dx, state);
    if (served == 0) return Outcome::reached;
    // twice as fast where that went well
    shift = served > shift ? served : served / 2;
    if (shift < smallest_shift) shift = 0;
  }
  return Outcome::not_converged;
}

}  // namespace gridshell
