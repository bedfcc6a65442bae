#include "engine/solve/newton.h"

#include <algorithm>
#include <cmath>

namespace gridshell {

NewtonReport newton(Linearisation& system, State& state, const NewtonOptions& options,
                    const Watch& watch) {
  NewtonReport report;
  Eigen::Matrix3Xd dx;
  const auto end = [&](Outcome outcome) {
    report.outcome = outcome;
    return report;
  };
  bool factor = true;
  double before = 0;
  for (report.iterations = 1; report.iterations <= options.most_iterations; ++report.iterations) {
    if (watch.cancelled()) return end(Outcome::cancelled);
    if (factor)
      report.inertia = system.at(state);
    else
      system.residual_at(state);
    ++system.effort().newton_iterations;
    if (!std::isfinite(system.assembly().energies.total())) return end(Outcome::not_finite);
    if (system.assembly().smallest_cosine < options.widest_turn) return end(Outcome::folded);
    if (!report.inertia.usable) return end(Outcome::not_finite);
    system.correction(dx);
    const double move = largest_column(dx);
    if (!std::isfinite(move)) return end(Outcome::not_finite);
    if (report.iterations == 1) report.first_move_mm = move;
    // twice as far as the step before, and not at the start: it runs away
    if (report.iterations > 4 && move > 2 * before && move > 100 * options.tolerance_mm)
      return end(Outcome::lost);
    if (move > options.farthest_mm) return end(Outcome::lost);
    system.apply(dx, state);
    report.last_move_mm = move;
    report.factored_move_mm = factor ? move : report.factored_move_mm + move;
    const double next = factor && options.trust_quadratic ? move * std::min(move, 1.0) : move;
    if (next <= options.tolerance_mm) return end(Outcome::reached);
    // an old factorisation serves near the end only, and while it shrinks the corrections
    const bool near = move < options.near_mm;
    factor = !near || (!factor && move > 0.1 * before);
    before = move;
  }
  return report;
}

}  // namespace gridshell
