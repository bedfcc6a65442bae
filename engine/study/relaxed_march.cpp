// Methods that come to rest by moving: dynamic relaxation, explicit and implicit dynamics.
#include <cmath>

#include "engine/study/method.h"
#include "engine/study/relaxation.h"

namespace gridshell::study {
namespace {

using record::RunOutcome;

RunOutcome claim_of(const BaselineReport& report) {
  if (report.end == Outcome::reached) return RunOutcome::right;
  if (report.end == Outcome::not_finite) return RunOutcome::blow_up;
  return report.end == Outcome::cancelled ? RunOutcome::too_slow : RunOutcome::not_converged;
}

const char* name_of(Relaxation kind) {
  switch (kind) {
    case Relaxation::kinetic:
      return "dynamic relaxation";
    case Relaxation::explicit_damped:
      return "explicit";
    case Relaxation::implicit_euler:
      break;
  }
  return "implicit Euler";
}

constexpr double density_kg_m3 = 6450, diameter_mm = 0.254;  // Nitinol wire

/// Of the slowest mode at the problem's end, 1/s.
double slowest_frequency(const Problem& problem, const Eigen::Matrix3Xd& mass) {
  Linearisation system(problem.model);
  system.at(problem.end, false);
  Eigen::Matrix3Xd mode = Eigen::Matrix3Xd::Random(3, problem.model.nodes);
  double frequency2 = 0;
  for (int k = 0; k < 30; ++k) {
    mode = mode.cwiseProduct(mass).eval();
    const double before = std::sqrt((mode.array().square() / mass.array()).sum());
    system.solve(mode);
    const double after = std::sqrt((mode.array().square() * mass.array()).sum());
    frequency2 = before / after;
    mode /= after;
  }
  return std::sqrt(frequency2);
}

/// A baseline on its way through a problem.
struct Walk {
  const Problem& problem;
  const Eigen::Matrix3Xd& mass;
  const RelaxMarch& options;
  MovingState moving;
  BaselineOptions how;

  void place(double t) {
    const Eigen::Matrix3Xd there = problem.motion.at(t);
    for (int node = 0; node < problem.model.nodes; ++node)
      if (problem.model.pinned(node)) moving.state.x.col(node) = there.col(node);
  }

  /// Load steps, at rest after each.
  RunOutcome steps(int count, const Watch& watch) {
    how.most_steps = 1 << 30;  // the time limit decides
    RunOutcome claim = RunOutcome::right;
    for (int k = 1; k <= count && claim == RunOutcome::right; ++k) {
      place(load_parameter(problem, k, count));
      how.tolerance_N = k == count ? options.tolerance_N : options.loose_N;
      claim = claim_of(options.kind == Relaxation::kinetic
                           ? dynamic_relaxation(problem.model, moving.state, how, watch)
                           : implicit_to_rest(problem.model, mass, moving, how, watch));
    }
    return claim;
  }

  /// The boundary moves for four periods of the slowest mode, which is damped critically; then to
  /// rest. A boundary that jumps would throw the shell about.
  RunOutcome ramp(bool moves, const Watch& watch) {
    constexpr int chunk = 20;  // time steps between two moves
    const double slowest = slowest_frequency(problem, mass);
    const double dt = how.step * courant_step(problem.model, mass);
    const int count = moves ? std::max(1, int(8 * M_PI / slowest / (chunk * dt))) : 0;
    how.damping_per_s = 2 * slowest;
    how.tolerance_N = options.tolerance_N;
    how.most_steps = chunk;
    for (int k = 1; k <= count; ++k) {
      place(load_parameter(problem, k, count));
      const BaselineReport report = explicit_to_rest(problem.model, mass, moving, how, watch);
      if (report.end == Outcome::not_finite || report.end == Outcome::cancelled)
        return claim_of(report);
    }
    how.most_steps = 1 << 30;
    return claim_of(explicit_to_rest(problem.model, mass, moving, how, watch));
  }
};

}  // namespace

Arrival march_relaxed(const Problem& problem, const RelaxMarch& options, Stopwatch& stopwatch,
                      const Watch& watch) {
  Arrival arrival;
  arrival.edges = problem.edges;
  arrival.dof = problem.model.dof();
  arrival.whole_mesh = true;
  const auto mass = lumped_mass(problem.model, {round_mass_t_per_mm(density_kg_m3, diameter_mm)});
  if (!mass) return arrival;
  Walk walk{problem, *mass, options, {}, {}};
  walk.moving = MovingState::at_rest(problem.start);
  walk.how.step = options.step;
  const bool moves = problem.motion.come(problem.t) < 1;
  stopwatch.start();
  if (options.kind == Relaxation::explicit_damped)
    arrival.claim = walk.ramp(moves, watch);
  else
    arrival.claim = walk.steps(moves ? options.load_steps : 1, watch);
  stopwatch.stop();
  arrival.x = std::move(walk.moving.state.x);
  return arrival;
}

Method relaxed_method(Relaxation kind, int edges) {
  return {name_of(kind), edges,
          [kind, edges](Subject& study, Stopwatch& stopwatch, const Watch& watch) -> Arrival {
            const auto problem = study.problem(edges, watch);
            if (!problem) return {RunOutcome::refused, {}, false, 0, 0, 0};
            RelaxMarch how{.kind = kind};
            if (kind == Relaxation::implicit_euler) how.step = 0.1;
            return march_relaxed(**problem, how, stopwatch, watch);
          }};
}

}  // namespace gridshell::study
