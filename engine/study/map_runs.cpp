#include "engine/study/map_runs.h"

#include <cmath>

#include "engine/solve/buckle.h"
#include "engine/study/relaxation.h"

namespace gridshell::study {

using record::RunOutcome;

Arrival by_default(Subject& study, LevelPlan plan, double tolerance, int stops,
                   const Watch& watch) {
  for (;;) {
    NestedShell shell = study.shell(plan, tolerance > 0 ? tolerance : 1e-3);
    NestedReport report = study.begin(shell, watch);
    const double from = progress_at(report.t);
    for (int k = 1; k <= stops && report.end == Outcome::reached; ++k)
      report = shell.advance(k == stops ? 1 : parameter_at(from + (1 - from) * k / stops), watch);
    Arrival arrival;
    arrival.edges = plan.edges_per_segment.back();
    arrival.whole_mesh = !plan.extrapolate;
    arrival.x = shell.state().x;
    arrival.claim = report.end == Outcome::reached     ? RunOutcome::right
                    : report.end == Outcome::cancelled ? RunOutcome::too_slow
                                                       : RunOutcome::refused;
    if (arrival.claim != RunOutcome::right || tolerance == 0 ||
        shell.state().error_estimate_mm <= tolerance * study.scale_mm())
      return arrival;
    const auto next = finer(plan);
    if (!next) {
      arrival.claim = RunOutcome::refused;  // the tolerance is not met, and the program says so
      return arrival;
    }
    plan = *next;
  }
}

Arrival hold(const Problem& problem, double over_l_c, const Watch& watch) {
  Arrival arrival;
  arrival.edges = problem.edges;
  arrival.whole_mesh = true;
  const Eigen::Matrix3Xd mass =
      lumped_mass(problem.model, {round_mass_t_per_mm(6450, 0.254)}).value();
  double shortest = INFINITY, along = 0;
  for (const ModelEdge& edge : problem.model.edges) shortest = std::min(shortest, edge.rest_length);
  for (const ModelEdge& edge : problem.model.edges) along += edge.rest_length;
  const double c = std::sqrt(problem.model.edges[0].EA * along / mass.row(0).sum());
  BaselineOptions options;
  options.step = over_l_c * shortest / c / courant_step(problem.model, mass);
  options.damping_per_s = 100;
  options.tolerance_N = 0;
  options.most_steps = 20000;
  MovingState moving = MovingState::at_rest(problem.end);
  for (int node : problem.model.free_columns)
    for (int axis = 0; axis < 3; ++axis)
      moving.state.x(axis, node) += 0.01 * std::sin(1 + 2.3 * node + 1.7 * axis);
  const BaselineReport report = explicit_to_rest(problem.model, mass, moving, options, watch);
  arrival.claim = report.end == Outcome::not_finite  ? RunOutcome::blow_up
                  : report.end == Outcome::cancelled ? RunOutcome::too_slow
                                                     : RunOutcome::right;
  arrival.x = std::move(moving.state.x);
  return arrival;
}

Problem from_flat(const Subject& study, const Problem& problem, double height) {
  Problem flat = problem;
  const Eigen::Matrix3Xd end = problem.motion.at(problem.t);
  flat.motion = {study.scene().flat.all(problem.mesh.flat), {}, PathLaw::even};
  flat.motion.change = end - flat.motion.begin;
  flat.t = 0;
  flat.end = problem.start;
  flat.start.x = flat.motion.begin;
  flat.start.force.setZero();
  const double reach2 = problem.mesh.flat.colwise().squaredNorm().maxCoeff();
  const BuckleSeed& seed = study.scene().seed;
  for (int node : problem.model.free_columns) {
    const Eigen::Vector2d p = problem.mesh.flat.col(node);
    const double tilted = 1 - 0.8 * seed.up * seed.diagonal * p.x() * p.y() / reach2;
    flat.start.x(2, node) += seed.up * height * (1 - p.squaredNorm() / reach2) * tilted;
  }
  return flat;
}

Arrival buckle(const Subject& study, const Problem& problem, const Watch& watch) {
  Linearisation system(problem.model);
  Arrival arrival;
  arrival.edges = problem.edges;
  arrival.whole_mesh = true;
  arrival.claim = RunOutcome::refused;
  const auto first = first_buckled(system, problem.mesh, problem.motion, problem.t,
                                   study.scene().seed, study.scene().flat, watch);
  if (watch.cancelled()) arrival.claim = RunOutcome::too_slow;
  if (!first) return arrival;
  arrival.claim = RunOutcome::right;
  arrival.x = first->x;
  return arrival;
}

}  // namespace gridshell::study
