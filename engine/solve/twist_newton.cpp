#include "engine/solve/twist_newton.h"

#include <algorithm>
#include <cmath>

namespace gridshell {

TwistSolver::TwistSolver(const TwistModel& model)
    : model_(model), assembly_(model), ldl_(assembly_.hessian()) {
  length_ = 0;
  for (const TwistEdge& edge : model.edges) length_ += edge.rest_length;
  length_ /= double(model.edges.size());
  weight_.resize(model.dof());
  for (int k = 0; k < model.dof(); ++k)
    weight_[k] = model.free[k] < 3 * model.nodes ? 1 : length_ * length_;
}

Inertia TwistSolver::factor(double shift) {
  ++effort_.factorizations;
  return ldl_.factor(assembly_.hessian(), shift * weight_);
}

Eigen::VectorXd TwistSolver::correction() const {
  Eigen::VectorXd b(model_.dof());
  for (int k = 0; k < model_.dof(); ++k) b[k] = -assembly_.gradient()[model_.free[k]];
  const Eigen::VectorXd found = ldl_.solve(b);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(model_.unknowns());
  for (int k = 0; k < model_.dof(); ++k) step[model_.free[k]] = found[k];
  return step;
}

double TwistSolver::move_of(const Eigen::VectorXd& step) const {
  double largest = 0;
  for (int k = 0; k < model_.unknowns(); ++k) {
    const double size = std::abs(step[k]) * (k < 3 * model_.nodes ? 1 : length_);
    if (!(size <= largest)) largest = size;  // a nan is kept, not hidden
  }
  return largest;
}

double TwistSolver::residual() const {
  double largest = 0;
  for (int k : model_.free) {
    const double size = std::abs(assembly_.gradient()[k]) / (k < 3 * model_.nodes ? 1 : length_);
    if (!(size <= largest)) largest = size;
  }
  return largest;
}

void TwistSolver::apply(const Eigen::VectorXd& step, double factor, TwistState& state) const {
  const int n = 3 * model_.nodes;
  const Eigen::Matrix3Xd x =
      state.x + factor * Eigen::Map<const Eigen::Matrix3Xd>(step.data(), 3, model_.nodes);
  move_to(model_, x, state.angle + factor * step.tail(step.size() - n), state);
}

Inertia TwistSolver::inertia_at(const TwistState& state) {
  assembly_.hessian_at(state);
  return factor(0);
}

NewtonReport TwistSolver::rest(TwistState& state, const TwistOptions& options, const Watch& watch) {
  NewtonReport report;
  const auto end = [&](NewtonOutcome outcome) {
    report.outcome = outcome;
    report.residual_N = residual();
    return report;
  };
  const double longest = options.largest_move_mm > 0 ? options.largest_move_mm : length_;
  double shift = 0, before = 0;
  TwistState trial;
  for (report.iterations = 1; report.iterations <= options.most_iterations; ++report.iterations) {
    if (watch.cancelled()) return report;
    assembly_.hessian_at(state);
    ++effort_.newton_iterations;
    if (!std::isfinite(assembly_.energies().total())) return end(NewtonOutcome::not_finite);
    report.inertia = factor(shift);
    const double first = shift;
    while (options.saddles ? !report.inertia.usable : !report.inertia.positive_definite()) {
      if (shift > 1e8) return end(NewtonOutcome::not_finite);
      shift = std::max(4 * shift, 1e-6);
      report.inertia = factor(shift);
    }
    const Eigen::VectorXd step = correction();
    const double move = move_of(step);
    if (!std::isfinite(move)) return end(NewtonOutcome::not_finite);
    if (report.iterations == 1) report.first_move_mm = move;
    report.last_move_mm = move;
    // near, and not for the first time: full steps, the energy's round-off decides nothing
    const bool near = shift == 0 && move < 1e-3 * length_ && (before == 0 || move < before);
    before = move;
    if (near || options.saddles) {
      apply(step, std::min(1.0, longest / move), state);
      if (move <= options.tolerance_mm)
        return end(assembly_.smallest_cosine() < options.widest_turn ? NewtonOutcome::folded
                                                                     : NewtonOutcome::converged);
      continue;
    }
    const double start = assembly_.energies().total(), slope = assembly_.gradient().dot(step);
    double factor = std::min(1.0, longest / move);
    const double whole = factor;
    for (; factor > 1e-10; factor /= 2) {
      trial = state;
      apply(step, factor, trial);
      const double energy = energies_of(model_, trial).total();
      if (energy <= start + 1e-4 * factor * slope + 1e-14 * std::abs(start)) break;
    }
    std::swap(state, trial);
    if (factor == whole && first == shift) shift = shift < 1e-5 ? 0 : shift / 4;
  }
  return report;
}

Eigen::VectorXd TwistSolver::velocity(const TwistState& state, const Eigen::Matrix3Xd& held,
                                      double load) {
  Eigen::VectorXd way = Eigen::VectorXd::Zero(model_.unknowns());
  for (int k = 0; k < 3 * model_.nodes; ++k)
    if (model_.fixed[k]) way[k] = held.data()[k];
  const double largest = way.cwiseAbs().maxCoeff();
  // how the forces change as what is held moves; central, so the step may be far above round-off
  const double h = 1e-4 * length_ / std::max(largest, 1e-4 * length_);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(model_.dof());
  for (double side : {1.0, -1.0}) {
    TwistState beside = state;
    apply(way, side * h, beside);
    beside.load += side * h * load;
    assembly_.gradient_at(beside);
    for (int k = 0; k < model_.dof(); ++k)
      change[k] -= side / (2 * h) * assembly_.gradient()[model_.free[k]];
  }
  const Eigen::VectorXd found = ldl_.solve(change);
  for (int k = 0; k < model_.dof(); ++k) way[model_.free[k]] = found[k];
  return way;
}

Eigen::VectorXd TwistSolver::softest_mode(const TwistState& state) {
  assembly_.hessian_at(state);
  double shift = 1e-9;
  while (!factor(shift).positive_definite() && shift < 1e6) shift *= 2;
  Eigen::VectorXd mode(model_.dof());
  for (int k = 0; k < model_.dof(); ++k) mode[k] = std::sin(0.7 + 1.3 * k) + 0.3;
  for (int k = 0; k < 60; ++k) {
    mode = ldl_.solve(mode.cwiseProduct(weight_));
    mode /= mode.norm();
  }
  Eigen::VectorXd all = Eigen::VectorXd::Zero(model_.unknowns());
  for (int k = 0; k < model_.dof(); ++k) all[model_.free[k]] = mode[k];
  return all;
}

}  // namespace gridshell
