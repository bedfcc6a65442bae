#include "engine/study/relaxation.h"

#include <algorithm>
#include <cmath>

#include "engine/solve/linearisation.h"

namespace gridshell::study {
namespace {

/// one explicit step of the free nodes, the kick over `kick` and the drift over h; returns the
/// kinetic energy after it
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

/// energies beyond any the rods could hold: strained by more than one half
bool grown(const Assembly& assembly) {
  return !(std::abs(assembly.largest_strain) < 0.5) || !std::isfinite(assembly.energies.total());
}

/// assembles the gradient, and whether that ends the way: at rest, beyond all bounds or cancelled
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

/// one implicit step; false where Newton's method does not solve it, the motion is then unchanged
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
    const double move = largest_column(dx);
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
  // a quarter of what a row of the Hessian sums up to at most where rods are straight: no mode is
  // then faster than 2, and a step of 1 is at the limit (Gershgorin)
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
    // velocities stand half a step after positions: the first from rest is half a kick; a whole one
    // would feed the fast modes at every restart
    const double kick = from_rest ? 0.5 * h : h;
    const double kinetic = kick_and_drift(model, mass, kick, h, 1, assembly, state.x, velocity);
    from_rest = kinetic < before;
    if (from_rest) {
      // the peak lies a step and a half back; without the way back the fast modes' peaks would stop
      // the slow ones again and again
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
    if (watch.cancelled()) return report.end = Outcome::cancelled, report;
    assemble_gradient(model, moving.state, {}, assembly);
    report.residual_N = residual_of(model, assembly.gradient);
    if (report.residual_N < options.tolerance_N) return report.end = Outcome::reached, report;
    if (!euler_step(model, mass, h, inertia, *solver, assembly, moving))
      return report.end = grown(assembly) ? Outcome::not_finite : Outcome::not_converged, report;
  }
  return report;
}

}  // namespace gridshell::study
