// Newton's method the textbook's way.
#include <algorithm>
#include <cmath>

#include "engine/study/method.h"

namespace gridshell::study {
namespace {

using record::RunOutcome;

/// Full or shortened Newton steps on the energy's Hessian, whatever its inertia.
RunOutcome rest_unshifted(Linearisation& system, State& state, const MarchOptions& options,
                          const Watch& watch) {
  Eigen::Matrix3Xd dx;
  State trial;
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
      const auto unbalanced = [&](Eigen::Matrix3Xd gradient) {
        clear_held(system.model(), gradient);
        return gradient.norm();
      };
      const double before = unbalanced(system.assembly().gradient);
      for (; factor > 1e-6; factor /= 2) {
        trial = state;
        move_to(system.model(), state.x + factor * dx, trial);
        assemble_gradient(system.model(), trial, system.outside, there);
        const double after = unbalanced(there.gradient);
        if (after <= (1 - 1e-4 * factor) * before) break;
      }
    }
    move_to(system.model(), state.x + factor * dx, state);
    if (move <= options.tolerance_mm) return RunOutcome::right;
    if (move > 1e6) return RunOutcome::blow_up;
  }
  return RunOutcome::not_converged;
}

/// The Hessian shifted until it is positive definite, the step shortened until the energy falls.
RunOutcome rest_shifted(Linearisation& system, State& state, const MarchOptions& options,
                        const Watch& watch) {
  const auto energy_at = [&](const State& at) {
    Energies energies = energies_of(system.model(), at, system.outside);
    energies[Term::stretch] *= options.EA_scale;
    return energies.total();
  };
  Eigen::Matrix3Xd dx;
  State trial;
  double shift = 0;
  for (int k = 0; k < options.most_iterations; ++k) {
    if (watch.cancelled()) return RunOutcome::too_slow;
    Inertia inertia = system.at(state, false, shift, options.EA_scale);
    const double first = shift;
    while (!inertia.positive_definite()) {
      if (shift > 1e8) return RunOutcome::blow_up;
      shift = std::max(4 * shift, 1e-6);
      inertia = system.shifted(shift);
    }
    system.correction(dx);
    const double move = largest_column(dx);
    if (!std::isfinite(move)) return RunOutcome::blow_up;
    if (move <= options.tolerance_mm && shift == 0) {
      move_to(system.model(), state.x + dx, state);
      return RunOutcome::right;
    }
    const double start = energy_at(state),
                 slope = (system.assembly().gradient.array() * dx.array()).sum();
    double step = 1;
    for (; step > 1e-10; step /= 2) {
      trial = state;
      move_to(system.model(), state.x + step * dx, trial);
      if (energy_at(trial) <= start + 1e-4 * step * slope + 1e-14 * std::abs(start)) break;
    }
    std::swap(state, trial);
    shift = step == 1 && first == shift ? (shift < 1e-5 ? 0 : shift / 4) : shift;
  }
  return RunOutcome::not_converged;
}

RunOutcome rest(Linearisation& system, State& state, const MarchOptions& options,
                const Watch& watch) {
  return options.globalisation == Globalisation::shifted
             ? rest_shifted(system, state, options, watch)
             : rest_unshifted(system, state, options, watch);
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
    problem.motion.impose(system, load_parameter(problem, k, steps), state);
    arrival.claim = rest(system, state, options, watch);
    if (arrival.claim != RunOutcome::right) break;
  }
  stopwatch.stop();
  arrival.negative_pivots = system.at(state, false).negative_pivots;
  arrival.x = nodes_of(problem.mesh, problem.model, state.x);
  return arrival;
}

Method textbook_method(int edges) {
  return {"Newton + CHOLMOD", edges,
          [edges](Subject& study, Stopwatch& stopwatch, const Watch& watch) -> Arrival {
            const auto problem = study.problem(edges, watch);
            if (!problem) return {RunOutcome::refused, {}, false, 0, 0, 0};
            return march(**problem, {}, stopwatch, watch);
          }};
}

}  // namespace gridshell::study
