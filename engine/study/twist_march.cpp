// Rods on the twist rung, with shared joints or joints of springs.
#include <fmt/format.h>

#include "engine/gridshell/twist_model.h"
#include "engine/rod/material.h"
#include "engine/solve/twist_newton.h"
#include "engine/study/method.h"

namespace gridshell::study {
namespace {

using record::RunOutcome;

constexpr double shear_over_young = 31.0 / 83;  // of Nitinol; at rest these rods do not twist

/// Rods of a mesh, those of the second family with nodes of their own at the joints where springs
/// hold them there: the joint's index after all other nodes.
Result<TwistModel> model_of(const Case& study, const Problem& problem, double stiffness) {
  const int nodes = problem.mesh.nodes(), joints = problem.mesh.joints;
  std::vector<TwistRod> rods;
  for (std::size_t r = 0; r < problem.mesh.rods.size(); ++r) {
    const RodSection& section = study.scene().rods.section(r);
    const double GJ = 2 * section.EI * shear_over_young;
    TwistRod rod{problem.mesh.rods[r], problem.mesh.position[r], round_material(section, GJ)};
    const auto hold = [&](int node) {
      return problem.model.pinned[std::size_t(node)] ? RodEnd::pinned : RodEnd::free;
    };
    rod.begin = hold(rod.nodes.front());
    rod.end = hold(rod.nodes.back());
    if (stiffness > 0 && study.scene().footprint.rods[r].family == Family::v)
      for (int& node : rod.nodes)
        if (node < joints) node += nodes;
    rods.push_back(std::move(rod));
  }
  auto model = build_twist_model(stiffness > 0 ? nodes + joints : nodes, rods);
  if (!model) return model;
  for (int k = 0; k < joints; ++k) {
    if (stiffness > 0) model->springs.push_back({k, nodes + k, stiffness});
    if (problem.model.pinned[std::size_t(k)]) model->fix_node(k);
  }
  model->number();
  return model;
}

/// Positions with the doubles of the joints, if there are any.
Eigen::Matrix3Xd doubled(const Eigen::Matrix3Xd& x, int joints, int nodes) {
  Eigen::Matrix3Xd all(3, nodes);
  all.leftCols(x.cols()) = x;
  if (nodes > x.cols()) all.rightCols(joints) = x.leftCols(joints);
  return all;
}

struct Walk {
  const Problem& problem;
  const TwistModel& model;
  TwistState state, before;
  double t, t_before;

  /// On in the direction of the last step, pinned nodes where they belong.
  void predict(double next) {
    const double ahead = t == t_before ? 0 : (next - t) / (t - t_before);
    Eigen::Matrix3Xd x = state.x + ahead * (state.x - before.x);
    const Eigen::VectorXd angle = state.angle + ahead * (state.angle - before.angle);
    const Eigen::Matrix3Xd there = problem.motion.at(next);
    for (int node = 0; node < problem.model.nodes; ++node)
      if (problem.model.pinned[std::size_t(node)]) x.col(node) = there.col(node);
    before = state;
    t_before = t;
    t = next;
    move_to(model, x, angle, state);
  }
};

}  // namespace

Arrival march_twist(const Case& study, const Problem& problem, const TwistMarch& options,
                    Stopwatch& stopwatch, const Watch& watch) {
  Arrival arrival;
  arrival.edges = problem.edges;
  arrival.claim = RunOutcome::refused;
  if (problem.mesh.ghosts > 0) return arrival;  // held directions are not part of this comparison
  stopwatch.start();
  auto model = model_of(study, problem, options.stiffness_N_per_mm);
  if (!model) return arrival;
  arrival.dof = model->dof();
  const int joints = problem.mesh.joints;
  TwistSolver solver(*model);
  const TwistState start =
      start_twist_state(*model, doubled(problem.start.x, joints, model->nodes));
  Walk walk{problem, *model, start, start, problem.t, problem.t};
  const int steps = problem.motion.come(problem.t) == 1 ? 1 : options.load_steps;
  TwistOptions how;
  how.saddles = options.saddles;
  if (options.saddles) how.most_iterations = 100;
  for (int k = 1; k <= steps; ++k) {
    if (steps > 1) walk.predict(load_parameter(problem, k, steps));
    how.tolerance_mm = k == steps ? options.tolerance_mm : 1e-3;
    const NewtonReport report = solver.rest(walk.state, how, watch);
    const bool finite = report.outcome != NewtonOutcome::not_finite;
    arrival.claim = report.outcome == NewtonOutcome::converged ? RunOutcome::right
                    : watch.cancelled()                        ? RunOutcome::too_slow
                    : finite                                   ? RunOutcome::not_converged
                                                               : RunOutcome::blow_up;
    arrival.negative_pivots = report.inertia.negative_pivots;
    if (arrival.claim != RunOutcome::right) break;
  }
  stopwatch.stop();
  arrival.x = walk.state.x.leftCols(problem.model.nodes);
  if (model->nodes > problem.model.nodes)
    arrival.x.leftCols(joints) =
        0.5 * (walk.state.x.leftCols(joints) + walk.state.x.rightCols(joints));
  arrival.whole_mesh = model->nodes == problem.model.nodes;
  return arrival;
}

namespace {

Method twist_or_spring(const std::string& name, int edges, double stiffness) {
  return {name, edges,
          [edges, stiffness](Case& study, Stopwatch& stopwatch, const Watch& watch) -> Arrival {
            const auto problem = study.problem(edges, watch);
            if (!problem) return {RunOutcome::refused, {}, false, 0, 0, 0};
            return march_twist(study, **problem, {.stiffness_N_per_mm = stiffness}, stopwatch,
                               watch);
          }};
}

}  // namespace

Method twist_method(int edges) { return twist_or_spring("twist", edges, 0); }

Method spring_method(int edges, double stiffness_N_per_mm) {
  return twist_or_spring(fmt::format("springs {:g} N/mm", stiffness_N_per_mm), edges,
                         stiffness_N_per_mm);
}

}  // namespace gridshell::study
