#include "engine/solve/newton.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace gridshell {
namespace {

// of the order of a shell's own stiffness, so that neither swamps the other
constexpr double border_stiffness = 1;  // g, N/mm

}  // namespace

Linearisation::Linearisation(const Model& model, std::unique_ptr<LinearSolver> solver)
    : model_(model), solver_(solver ? std::move(solver) : make_linear_solver(model)) {}

Inertia Linearisation::at(const State& state, bool mixed, double shift, double EA_scale) {
  EA_scale_ = EA_scale;
  assemble_hessian(model_, state.x, mixed ? &state.force : nullptr, EA_scale, assembly_);
  add_loads(model_, state.x, load_factor_, assembly_);
  tangents_ = assembly_.tangents;
  if (prescription_.active())
    assembly_.hessian.diagonal[prescription_.node] +=
        border_stiffness * prescription_.directions * prescription_.directions.transpose();
  return shifted(shift);
}

Inertia Linearisation::shifted(double shift) {
  ++effort_.factorizations;
  Inertia inertia = solver_->factor(assembly_.hessian, shift);
  if (prescription_.active() && inertia.usable) border(inertia);
  return inertia;
}

/// Inertia of the bordered matrix [K B; B^T 0]: that of K and of the Schur complement -C; the
/// border itself brings m positive and m negative ones [Haynsworth 1968].
void Linearisation::border(Inertia& inertia) {
  const Eigen::Index m = prescription_.directions.cols();
  border_.resize(std::size_t(m));
  compliance_.resize(m, m);
  for (Eigen::Index k = 0; k < m; ++k) {
    Eigen::Matrix3Xd& column = border_[std::size_t(k)];
    column.setZero(3, model_.nodes);
    column.col(prescription_.node) = prescription_.directions.col(k);
    solver_->solve(column);
    compliance_.col(k) = prescription_.directions.transpose() * column.col(prescription_.node);
  }
  compliance_ = (0.5 * (compliance_ + compliance_.transpose())).eval();
  const Eigen::VectorXd own =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(compliance_, Eigen::EigenvaluesOnly)
          .eigenvalues();
  inertia.usable = own.allFinite() && (own.array() != 0).all();
  inertia.negative_pivots += int((own.array() > 0).count()) - int(m);
}

void Linearisation::solve(Eigen::Matrix3Xd& right_hand_side) const {
  solver_->solve(right_hand_side);
  if (!prescription_.active()) return;
  const Eigen::VectorXd moved =
      prescription_.directions.transpose() * right_hand_side.col(prescription_.node);
  const Eigen::VectorXd force = compliance_.partialPivLu().solve(moved);
  for (std::size_t k = 0; k < border_.size(); ++k)
    right_hand_side -= force[Eigen::Index(k)] * border_[k];
}

Eigen::MatrixXd Linearisation::prescribed_stiffness() const {
  Eigen::MatrixXd stiffness = compliance_.inverse();
  stiffness.diagonal().array() -= border_stiffness;
  return stiffness;
}

double Linearisation::residual() const {
  if (!prescription_.active()) return residual_of(model_, assembly_.gradient);
  Eigen::Matrix3Xd unheld = assembly_.gradient;
  unheld.col(prescription_.node) -= prescription_.part(reaction());
  return residual_of(model_, unheld);
}

void Linearisation::residual_at(const State& state) {
  assemble_mixed_residual(model_, state.x, state.force, tangents_, assembly_);
  add_loads(model_, state.x, load_factor_, assembly_);
}

void Linearisation::gradient_at(const State& state) {
  assemble_gradient(model_, state.x, assembly_);
  add_loads(model_, state.x, load_factor_, assembly_);
}

void Linearisation::correction(Eigen::Matrix3Xd& dx) const {
  dx = -assembly_.gradient;
  solve(dx);
}

void Linearisation::tangent(const Eigen::Matrix3Xd& pinned_velocity, Eigen::Matrix3Xd& velocity,
                            double load_velocity) const {
  Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, model_.nodes);
  for (int node = 0; node < model_.nodes; ++node)
    if (model_.pinned[node]) moved.col(node) = pinned_velocity.col(node);
  if (prescription_.active())
    moved.col(prescription_.node) = prescription_.part(pinned_velocity.col(prescription_.node));
  multiply(model_, assembly_.hessian, moved, velocity);
  velocity *= -1;
  if (model_.load.size() > 0) velocity += load_velocity * model_.load;
  solve(velocity);
  velocity += moved;
}

Eigen::VectorXd Linearisation::force_change(const Eigen::Matrix3Xd& dx) const {
  Eigen::VectorXd change(Eigen::Index(model_.edges.size()));
  for (std::size_t k = 0; k < model_.edges.size(); ++k) {
    const ModelEdge& edge = model_.edges[k];
    change[k] = EA_scale_ * edge.EA / edge.rest_length *
                tangents_.col(k).dot(dx.col(edge.to) - dx.col(edge.from));
  }
  return change;
}

void Linearisation::apply(const Eigen::Matrix3Xd& dx, State& state) const {
  state.x += dx;
  state.force = assembly_.force + force_change(dx);
}

void Linearisation::restore_lengths(const Eigen::VectorXd& force, Eigen::Matrix3Xd& x) const {
  Eigen::Matrix3Xd pull = Eigen::Matrix3Xd::Zero(3, model_.nodes);
  for (std::size_t k = 0; k < model_.edges.size(); ++k) {
    const ModelEdge& edge = model_.edges[k];
    const double strain = (x.col(edge.to) - x.col(edge.from)).norm() / edge.rest_length - 1;
    const double excess = EA_scale_ * edge.EA * strain - force[Eigen::Index(k)];
    pull.col(edge.from) += excess * tangents_.col(k);
    pull.col(edge.to) -= excess * tangents_.col(k);
  }
  solve(pull);
  x += pull;
}

double largest_column(const Eigen::Matrix3Xd& dx) {
  double largest = 0;
  for (Eigen::Index k = 0; k < dx.cols(); ++k) {
    const double size = dx.col(k).squaredNorm();
    if (!(size <= largest)) largest = size;  // a nan is kept, not hidden
  }
  return std::sqrt(largest);
}

NewtonReport newton(Linearisation& system, State& state, const NewtonOptions& options) {
  NewtonReport report;
  Eigen::Matrix3Xd dx;
  const auto end = [&](NewtonOutcome outcome) {
    report.outcome = outcome;
    return report;
  };
  bool factor = true;
  double before = 0;
  for (report.iterations = 1; report.iterations <= options.most_iterations; ++report.iterations) {
    if (factor)
      report.inertia = system.at(state);
    else
      system.residual_at(state);
    ++system.effort().newton_iterations;
    if (!std::isfinite(system.assembly().energies.total())) return end(NewtonOutcome::not_finite);
    if (system.assembly().largest_turn < options.widest_turn) return end(NewtonOutcome::folded);
    if (!report.inertia.usable) return end(NewtonOutcome::not_finite);
    system.correction(dx);
    const double move = largest_column(dx);
    if (!std::isfinite(move)) return end(NewtonOutcome::not_finite);
    if (report.iterations == 1) report.first_move_mm = move;
    // twice as far as the step before, and not at the start: it runs away
    if (report.iterations > 4 && move > 2 * before && move > 100 * options.tolerance_mm)
      return end(NewtonOutcome::diverged);
    if (move > options.farthest_mm) return end(NewtonOutcome::diverged);
    system.apply(dx, state);
    report.last_move_mm = move;
    report.factored_move_mm = factor ? move : report.factored_move_mm + move;
    const double next = factor && options.trust_quadratic ? move * std::min(move, 1.0) : move;
    if (next <= options.tolerance_mm) return end(NewtonOutcome::converged);
    // an old factorisation serves near the end only, and while it shrinks the corrections
    const bool near = move < options.near_mm;
    factor = !near || (!factor && move > 0.1 * before);
    before = move;
  }
  return report;
}

}  // namespace gridshell
