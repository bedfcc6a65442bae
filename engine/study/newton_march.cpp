// Newton's method the textbook's way.
#include <cmath>

#include "engine/study/method.h"

namespace gridshell::study {
namespace {

using record::RunOutcome;

/// Full or shortened Newton steps on the energy's Hessian, whatever its inertia.
RunOutcome rest_unshifted(Linearisation& system, State& state, const MarchOptions& options,
                          const Watch& watch) {
  Eigen::Matrix3Xd dx, trial;
  Assembly there;
  for (int k = 0; k < options.most_iterations; ++k) {
    if (watch.cancelled()) return RunOutcome::too_slow;
    if (!system.at(state, false, 0, options.EA_scale).usable) return RunOutcome::blow_up;
    system.correction(dx);
    const double move = largest_column(dx);
    if (!std::isfinite(move) || !std::isfinite(system.assembly().energies.total()))
      return RunOutcome::blow_up;
    double factor = 1;
    if (options.globalisation == Globalisation::line_search) {
      // the residual falls along Newton's direction, whatever the inertia
      const double before =
          system.assembly().gradient(Eigen::all, system.model().free_nodes).norm();
      for (; factor > 1e-6; factor /= 2) {
        trial = state.x + factor * dx;
        assemble_gradient(system.model(), trial, there);
        const double after = there.gradient(Eigen::all, system.model().free_nodes).norm();
        if (after <= (1 - 1e-4 * factor) * before) break;
      }
    }
    state.x += factor * dx;
    if (move <= options.tolerance_mm) return RunOutcome::right;
    if (move > 1e6) return RunOutcome::blow_up;
  }
  return RunOutcome::not_converged;
}

RunOutcome rest(Linearisation& system, State& state, const MarchOptions& options,
                const Watch& watch) {
  if (options.globalisation != Globalisation::shifted)
    return rest_unshifted(system, state, options, watch);
  MinimiseOptions how;
  how.tolerance_mm = options.tolerance_mm;
  how.most_iterations = options.most_iterations;
  how.EA_scale = options.EA_scale;
  const NewtonReport report = minimise(system, state, how, watch);
  if (watch.cancelled()) return RunOutcome::too_slow;
  switch (report.outcome) {
    case NewtonOutcome::converged:
      return RunOutcome::right;
    case NewtonOutcome::not_finite:
      return RunOutcome::blow_up;
    default:
      return RunOutcome::not_converged;
  }
}

}  // namespace

const char* name_of(Globalisation globalisation) {
  switch (globalisation) {
    case Globalisation::none:
      return "full steps";
    case Globalisation::line_search:
      return "line search";
    case Globalisation::shifted:
      break;
  }
  return "shifted";
}

Arrival march(const Problem& problem, const MarchOptions& options, Stopwatch& stopwatch,
              const Watch& watch) {
  Arrival arrival;
  arrival.edges = problem.edges;
  arrival.dof = problem.model.dof();
  arrival.whole_mesh = options.EA_scale == 1;
  stopwatch.start();
  Linearisation system(problem.model,
                       make_cholmod(problem.model, {.supernodal = true, .own_ordering = false}));
  State state = problem.start;
  const int steps = problem.motion.come(problem.t) == 1 ? 1 : options.load_steps;
  for (int k = 1; k <= steps; ++k) {
    problem.motion.impose(system, load_parameter(problem, k, steps), state.x);
    arrival.claim = rest(system, state, options, watch);
    if (arrival.claim != RunOutcome::right) break;
  }
  stopwatch.stop();
  arrival.x = std::move(state.x);
  return arrival;
}

Method textbook_method(int edges) {
  return {"Newton + CHOLMOD", edges,
          [edges](Case& study, Stopwatch& stopwatch, const Watch& watch) -> Arrival {
            const auto problem = study.problem(edges, watch);
            if (!problem) return {RunOutcome::refused, {}, false, 0, 0};
            return march(**problem, {}, stopwatch, watch);
          }};
}

}  // namespace gridshell::study
