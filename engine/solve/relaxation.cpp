#include "engine/solve/relaxation.h"

#include <algorithm>
#include <cmath>

namespace gridshell {
namespace {

/// one explicit step of the free nodes; returns the kinetic energy after it
double kick_and_drift(const Model& model, const Eigen::VectorXd& mass, double h, double keep,
                      const Assembly& assembly, Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& velocity) {
  double kinetic = 0;
  for (int node : model.free_nodes) {
    velocity.col(node) = keep * velocity.col(node) - h / mass[node] * assembly.gradient.col(node);
    x.col(node) += h * velocity.col(node);
    kinetic += 0.5 * mass[node] * velocity.col(node).squaredNorm();
  }
  return kinetic;
}

/// energies beyond any the rods could hold: strained by more than one half
bool grown(const Assembly& assembly) {
  return !(assembly.largest_strain < 0.5) || !std::isfinite(assembly.energies.total());
}

}  // namespace

double courant_step(const Model& model, const Eigen::VectorXd& mass) {
  double least = 1e300;
  for (const ModelEdge& edge : model.edges)
    least = std::min(
        least, std::sqrt(std::min(mass[edge.from], mass[edge.to]) * edge.rest_length / edge.EA));
  return least;
}

BaselineReport explicit_to_rest(const Model& model, const Eigen::VectorXd& mass, Motion& motion,
                                const BaselineOptions& options, const Watch& watch) {
  BaselineReport report;
  Assembly assembly;
  const double h = options.step * courant_step(model, mass);
  const double keep = 1 / (1 + h * options.damping_per_s);
  for (report.steps = 0; report.steps < options.most_steps; ++report.steps) {
    assemble_gradient(model, motion.x, assembly);
    report.residual_N = residual_of(model, assembly.gradient);
    if (grown(assembly)) return report.end = BaselineEnd::blow_up, report;
    if (report.residual_N < options.tolerance_N) return report.end = BaselineEnd::at_rest, report;
    if (watch.cancelled()) return report.end = BaselineEnd::cancelled, report;
    kick_and_drift(model, mass, h, keep, assembly, motion.x, motion.velocity);
    motion.time += h;
  }
  return report;
}

BaselineReport dynamic_relaxation(const Model& model, Eigen::Matrix3Xd& x,
                                  const BaselineOptions& options, const Watch& watch) {
  BaselineReport report;
  // masses for which a step of 1 is at the limit: half the row's stiffness
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(model.nodes);
  for (const ModelEdge& edge : model.edges)
    for (int node : {edge.from, edge.to}) mass[node] += edge.EA / edge.rest_length;
  for (const ModelBend& bend : model.bends) {
    const ModelEdge &e = model.edges[bend.edge], &f = model.edges[bend.edge + 1];
    const double k = 4 * bend.stiffness / (e.rest_length * f.rest_length);
    for (int node : {e.from, e.to, f.to}) mass[node] += k;
  }
  mass *= 0.5;
  Assembly assembly;
  Eigen::Matrix3Xd velocity = Eigen::Matrix3Xd::Zero(3, model.nodes);
  double before = 0;
  for (report.steps = 0; report.steps < options.most_steps; ++report.steps) {
    assemble_gradient(model, x, assembly);
    report.residual_N = residual_of(model, assembly.gradient);
    if (grown(assembly)) return report.end = BaselineEnd::blow_up, report;
    if (report.residual_N < options.tolerance_N) return report.end = BaselineEnd::at_rest, report;
    if (watch.cancelled()) return report.end = BaselineEnd::cancelled, report;
    const double kinetic = kick_and_drift(model, mass, options.step, 1, assembly, x, velocity);
    if (kinetic < before) velocity.setZero();
    before = kinetic < before ? 0 : kinetic;
  }
  return report;
}

}  // namespace gridshell
