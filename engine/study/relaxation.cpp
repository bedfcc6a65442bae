
#include <algorithm>
#include <cmath>

#include "engine/core/system_info.h"
#include "engine/elastic/model.h"
#include "engine/solve/newton.h"
#include "engine/study/benchmark_methods.h"
#include "engine/study/bifurcation_diagram.h"

namespace gridshell::study {
namespace {

/// One explicit step of the free nodes: v = keep v + kick F / m, x += h v. Returns the kinetic
/// energy after it.
double kick_and_drift(const Model& model, const Eigen::Matrix3Xd& mass, double kick, double h,
                      double keep, const Assembly& assembly, Eigen::Matrix3Xd& x,
                      Eigen::Matrix3Xd& velocity) {
  double kinetic = 0;
  for (int node : model.free_columns) {
    velocity.col(node) =
        keep * velocity.col(node) - kick / mass(0, node) * assembly.gradient.col(node);
    x.col(node) += h * velocity.col(node);
    kinetic += 0.5 * mass(0, node) * velocity.col(node).squaredNorm();
  }
  return kinetic;
}

/// Whether the run diverges: an edge is strained by more than one half, or the energy is not
/// finite.
bool grown(const Assembly& assembly) {
  return !(std::abs(assembly.largest_strain) < 0.5) || !std::isfinite(assembly.energies.total());
}

/// Assembles the gradient; returns whether the run ends, in equilibrium, diverged or cancelled.
bool ended(const Model& model, const State& state, const BaselineOptions& options,
           const Watch& watch, Assembly& assembly, BaselineReport& report) {
  assemble_gradient(model, state, {}, assembly);
  report.residual_N = residual_of(model, assembly.gradient);
  if (grown(assembly))
    report.end = Outcome::not_finite;
  else if (report.residual_N < options.tolerance_N)
    report.end = Outcome::reached;
  else if (watch.cancelled())
    report.end = Outcome::cancelled;
  else
    return false;
  return true;
}

/// One implicit step. Returns false if Newton's method does not solve it; the motion is then
/// unchanged.
bool euler_step(const Model& model, const Eigen::Matrix3Xd& mass, double h, double inertia,
                LinearSolver& solver, Assembly& assembly, MovingState& moving) {
  constexpr int most_iterations = 50;
  constexpr double tolerance_mm = 1e-7;
  State state = moving.state;
  Eigen::Matrix3Xd dx;
  for (int k = 0; k < most_iterations; ++k) {
    assemble_hessian(model, state, {}, {}, assembly);
    if (grown(assembly)) return false;
    dx = -assembly.gradient;
    for (int node : model.free_columns) {
      assembly.hessian.diagonal[std::size_t(node)].matrix().diagonal().array() +=
          inertia * mass(0, node);
      dx.col(node) += mass(0, node) * (moving.velocity.col(node) / h -
                                       inertia * (state.x.col(node) - moving.state.x.col(node)));
    }
    if (!solver.factor(assembly.hessian, 0).usable) return false;
    solver.solve(dx);
    const double move = max_column_norm(dx);
    if (!std::isfinite(move)) return false;
    state.x += dx;
    if (move > tolerance_mm) continue;
    moving.velocity = (state.x - moving.state.x) / h;
    moving.state = std::move(state);
    moving.time += h;
    return true;
  }
  return false;
}

using record::RunOutcome;

constexpr double loose_N = 1e-3;  // largest force left between load steps

RunOutcome claim_of(const BaselineReport& report) {
  if (report.end == Outcome::reached) return RunOutcome::right;
  if (report.end == Outcome::not_finite) return RunOutcome::blow_up;
  return report.end == Outcome::cancelled ? RunOutcome::too_slow : RunOutcome::not_converged;
}

/// Angular frequency (rad/s) of the lowest mode at the problem's end, by inverse iteration.
double slowest_frequency(const Problem& problem, const Eigen::Matrix3Xd& mass) {
  Linearisation system(problem.model);
  system.at(problem.end, false);
  Eigen::Matrix3Xd mode =
      generic_vectors(3 * problem.model.nodes, 1).reshaped(3, problem.model.nodes);
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

/// A run of a baseline through a problem.
struct RelaxationRun {
  const Problem& problem;
  const Eigen::Matrix3Xd& mass;
  const RelaxationOptions& options;
  MovingState moving;
  BaselineOptions how = {.step = options.step};

  void move_boundary(double t) {
    const Eigen::Matrix3Xd there = problem.motion.at(t);
    for (int node = 0; node < problem.model.nodes; ++node)
      if (problem.model.pinned(node)) moving.state.x.col(node) = there.col(node);
  }

  /// Moves the boundary in load steps, each until equilibrium.
  RunOutcome steps(int count, const Watch& watch) {
    how.most_steps = 1 << 30;  // the time limit decides
    RunOutcome claim = RunOutcome::right;
    for (int k = 1; k <= count && claim == RunOutcome::right; ++k) {
      move_boundary(problem.load_parameter(k, count));
      how.tolerance_N = k == count ? options.tolerance_N : loose_N;
      claim = claim_of(options.kind == Relaxation::kinetic
                           ? dynamic_relaxation(problem.model, moving.state, how, watch)
                           : implicit_to_rest(problem.model, mass, moving, how, watch));
    }
    return claim;
  }

  /// Moves the boundary during four periods of the lowest mode, which is damped critically, then
  /// runs until equilibrium. A sudden motion would give the shell large velocities.
  RunOutcome ramp(bool moves, const Watch& watch) {
    constexpr int chunk = 20;  // time steps between two moves
    const double slowest = slowest_frequency(problem, mass);
    const double dt = how.step * courant_step(problem.model, mass);
    const int count = moves ? std::max(1, int(8 * M_PI / slowest / (chunk * dt))) : 0;
    how.damping_per_s = 2 * slowest;
    how.tolerance_N = options.tolerance_N;
    how.most_steps = chunk;
    for (int k = 1; k <= count; ++k) {
      move_boundary(problem.load_parameter(k, count));
      const BaselineReport report = explicit_to_rest(problem.model, mass, moving, how, watch);
      if (report.end == Outcome::not_finite || report.end == Outcome::cancelled)
        return claim_of(report);
    }
    how.most_steps = 1 << 30;
    return claim_of(explicit_to_rest(problem.model, mass, moving, how, watch));
  }
};

Eigen::Matrix3Xd mass_of_wire(const Model& model) {
  constexpr double density_kg_m3 = 6450, diameter_mm = 0.254;  // Nitinol
  return lumped_mass(model, {round_mass_t_per_mm(density_kg_m3, diameter_mm)}).value();
}

}  // namespace

double courant_step(const Model& model, const Eigen::Matrix3Xd& mass) {
  double least = 1e300;
  for (const ModelEdge& edge : model.edges)
    least = std::min(least, std::sqrt(std::min(mass(0, edge.from), mass(0, edge.to)) *
                                      edge.rest_length / edge.EA));
  return least;
}

BaselineReport explicit_to_rest(const Model& model, const Eigen::Matrix3Xd& mass,
                                MovingState& moving, const BaselineOptions& options,
                                const Watch& watch) {
  BaselineReport report;
  Assembly assembly;
  const double h = options.step * courant_step(model, mass);
  const double keep = 1 / (1 + h * options.damping_per_s);
  for (report.steps = 0; report.steps < options.most_steps; ++report.steps) {
    if (ended(model, moving.state, options, watch, assembly, report)) return report;
    kick_and_drift(model, mass, h, h, keep, assembly, moving.state.x, moving.velocity);
    moving.time += h;
  }
  return report;
}

BaselineReport dynamic_relaxation(const Model& model, State& state, const BaselineOptions& options,
                                  const Watch& watch) {
  BaselineReport report;
  // a mass is a quarter of the largest row sum of the Hessian of straight rods: by Gershgorin no
  // angular frequency is then above 2, and a step of 1 is the limit
  Eigen::Matrix3Xd mass = Eigen::Matrix3Xd::Zero(3, model.nodes);
  for (const ModelEdge& edge : model.edges)
    for (int node : {edge.from, edge.to}) mass(0, node) += edge.EA / edge.rest_length;
  for (const ModelBend& bend : model.bends) {
    const ModelEdge &e = model.edges[std::size_t(bend.e)], &f = model.edges[std::size_t(bend.f)];
    const double k = 4 * bend.stiffness / (e.rest_length * f.rest_length);
    for (int node : {e.from, e.to, f.to}) mass(0, node) += k;
  }
  mass *= 0.5;
  Assembly assembly;
  Eigen::Matrix3Xd velocity = Eigen::Matrix3Xd::Zero(3, model.nodes);
  const double h = options.step;
  double before = 0;
  bool from_rest = true;
  for (report.steps = 0; report.steps < options.most_steps; ++report.steps) {
    if (ended(model, state, options, watch, assembly, report)) return report;
    // velocities are half a step ahead of positions, so that the first change from zero velocity
    // is a half; a full one would excite the fast modes at every restart
    const double kick = from_rest ? 0.5 * h : h;
    const double kinetic = kick_and_drift(model, mass, kick, h, 1, assembly, state.x, velocity);
    from_rest = kinetic < before;
    if (from_rest) {
      // the peak was one and a half steps ago; if positions were not set back to it, the peaks of
      // the fast modes would stop the slow ones repeatedly
      for (int node : model.free_columns)
        state.x.col(node) -= 1.5 * h * velocity.col(node) +
                             0.5 * h * h / mass(0, node) * assembly.gradient.col(node);
      velocity.setZero();
    }
    before = from_rest ? 0 : kinetic;
  }
  return report;
}

BaselineReport implicit_to_rest(const Model& model, const Eigen::Matrix3Xd& mass,
                                MovingState& moving, const BaselineOptions& options,
                                const Watch& watch) {
  BaselineReport report;
  Assembly assembly;
  const auto solver = make_linear_solver(model);
  const double h = options.step, inertia = 1 / (h * h) + options.damping_per_s / h;
  for (; report.steps < options.most_steps; ++report.steps) {
    if (ended(model, moving.state, options, watch, assembly, report)) return report;
    if (!euler_step(model, mass, h, inertia, *solver, assembly, moving))
      return report.end = grown(assembly) ? Outcome::not_finite : Outcome::not_converged, report;
  }
  return report;
}

MethodResult relax(const Problem& problem, const RelaxationOptions& options, const Watch& watch) {
  MethodResult result = MethodResult::on(problem);
  const Eigen::Matrix3Xd mass = mass_of_wire(problem.model);
  RelaxationRun run{problem, mass, options, MovingState::at_rest(problem.start)};
  const bool moves = problem.motion.progress(problem.t) < 1;
  const double begin = cpu_seconds_now();
  result.claim = options.kind == Relaxation::explicit_damped
                     ? run.ramp(moves, watch)
                     : run.steps(moves ? options.load_steps : 1, watch);
  result.seconds = cpu_seconds_now() - begin;
  result.x = std::move(run.moving.state.x);
  return result;
}

MethodResult check_explicit_step(const Problem& problem, double over_l_c, const Watch& watch) {
  MethodResult result = MethodResult::on(problem);
  const Eigen::Matrix3Xd mass = mass_of_wire(problem.model);
  double shortest = INFINITY, along = 0;
  for (const ModelEdge& edge : problem.model.edges) {
    shortest = std::min(shortest, edge.rest_length);
    along += edge.rest_length;
  }
  const double c = std::sqrt(problem.model.edges[0].EA * along / mass.row(0).sum());
  const BaselineOptions options{.step = over_l_c * shortest / c / courant_step(problem.model, mass),
                                .damping_per_s = 100,
                                .tolerance_N = 0,
                                .most_steps = 20000};
  MovingState moving = MovingState::at_rest(problem.end);
  for (int node : problem.model.free_columns)
    for (int axis = 0; axis < 3; ++axis)
      moving.state.x(axis, node) += 0.01 * std::sin(1 + 2.3 * node + 1.7 * axis);
  const BaselineReport report = explicit_to_rest(problem.model, mass, moving, options, watch);
  // it need not converge but must not diverge
  result.claim = report.end == Outcome::not_converged ? RunOutcome::right : claim_of(report);
  result.x = std::move(moving.state.x);
  return result;
}

}  // namespace gridshell::study
