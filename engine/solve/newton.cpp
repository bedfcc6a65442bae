#include "engine/solve/newton.h"

#include <algorithm>
#include <cmath>

namespace gridshell {
namespace {

/// About what the correction after one of a new factorisation is, by its square. Over thirteen
/// presets of all kinds half were below m^2/l, nine in ten below 5 m^2/l but for three presets, and
/// beside a snap it was a hundred times that: what is left out then is still below a tenth of the
/// accuracy that tolerances are chosen for.
class NextMove {
 public:
  explicit NextMove(const Model& model) {
    double sum = 0;
    for (const ModelEdge& edge : model.edges) sum += edge.rest_length;
    by_square_ = 8 * double(model.edges.size()) / sum;
  }
  double after(double move) const { return by_square_ * move * move; }

 private:
  double by_square_;
};

}  // namespace

NewtonReport newton(Linearisation& system, State& state, const NewtonOptions& options,
                    const Watch& watch) {
  NewtonReport report;
  Eigen::Matrix3Xd dx;
  const auto end = [&](Outcome outcome) {
    report.outcome = outcome;
    return report;
  };
  const NextMove next_move(system.model());
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
    if (move <= options.tolerance_mm) return end(Outcome::reached);
    if (factor && next_move.after(move) <= options.trusted_mm &&
        (!options.trusted_misfit ||
         system.force_misfit(state) <= *options.trusted_misfit * state.force.cwiseAbs().maxCoeff()))
      return end(Outcome::reached);
    // an old factorisation serves near the end only, and while it shrinks the corrections
    const bool near = move < options.near_mm;
    factor = !near || (!factor && move > 0.1 * before);
    before = move;
  }
  return report;
}

}  // namespace gridshell
