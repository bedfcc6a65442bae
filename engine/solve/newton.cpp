#include "engine/solve/newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/dense.h"
#include "engine/elastic/along_rods.h"
#include "engine/elastic/edge_energies.h"
#include "engine/elastic/model.h"

namespace gridshell {
namespace {

// of the order of a shell's stiffness, so that neither dominates the other
constexpr double border_stiffness = 1;  // g, N/mm

/// EA times the strain of an edge, N.
double force_of_strain(const ModelEdge& edge, const Eigen::Matrix3Xd& x) {
  return stretch(edge.EA, edge.rest_length, (x.col(edge.to) - x.col(edge.from)).norm()).force;
}

}  // namespace

double product(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cwiseProduct(b).sum();
}

Eigen::Vector3d Constraint::part(const Eigen::Vector3d& v) const {
  return directions * (directions.transpose() * v);
}

Linearisation::Linearisation(const Model& model, std::unique_ptr<LinearSolver> solver)
    : model_(model), solver_(solver ? std::move(solver) : make_linear_solver(model)) {}

Inertia Linearisation::at(const State& state, bool mixed, double shift, double EA_scale) {
  EA_scale_ = EA_scale;
  assemble_hessian(model_, state, outside, {mixed, EA_scale}, assembly_, solver_->team);
  tangents_ = assembly_.tangents;
  for (const Constraint& constraint : constraints_)
    assembly_.hessian.diagonal[std::size_t(constraint.node)].matrix() +=
        border_stiffness * constraint.directions * constraint.directions.transpose();
  return shifted(shift);
}

void Linearisation::free_memory() {
  solver_->free_memory();
  assembly_ = {};
  border_ = {};
}

Inertia Linearisation::shifted(double shift) {
  ++effort_.factorizations;
  shift_ = shift + neutral_shift_;
  Inertia inertia = solver_->factor(assembly_.hessian, shift_);
  if (!constraints_.empty() && inertia.usable) border(inertia);
  return inertia;
}

void Linearisation::bear_neutral_directions() {
  // fraction of the least stiff rod's stiffness in one half wave, EI (pi/L)^4 l per node: what a
  // single correction leaves along a direction without stiffness
  constexpr double fraction = 5e-5;
  double softest = std::numeric_limits<double>::infinity();
  // EI/l; of a section with two stiffnesses the smaller one
  const auto stiffness = [&](std::size_t k) {
    const auto section = law_of<SectionBending>(model_, int(k));
    return section ? section->bend.stiffness.minCoeff() : 0.5 * model_.bends[k].stiffness;
  };
  for (std::size_t k = 0; k < model_.bends.size();) {
    const ModelBend& first = model_.bends[k];
    // the ghost at an end of prescribed direction has no length; its bend follows a law of its own
    const auto length = [&](int edge) { return length_between(model_, edge, edge); };
    double rod = length(first.e), soft = 0;
    for (int e = first.e; k < model_.bends.size() && model_.bends[k].e == e; ++k) {
      const double l = length_between(model_, e, model_.bends[k].f);
      if (soft == 0) soft = stiffness(k) * l * l;
      rod += length(e = model_.bends[k].f);
    }
    if (soft > 0) softest = std::min(softest, soft * std::pow(M_PI / rod, 4));
  }
  if (std::isfinite(softest)) neutral_shift_ = fraction * softest;
}

Eigen::VectorXd Linearisation::constrained_part(const Eigen::Matrix3Xd& x) const {
  Eigen::VectorXd part(compliance_.rows());
  Eigen::Index at = 0;
  for (const Constraint& constraint : constraints_) {
    part.segment(at, constraint.directions.cols()) =
        constraint.directions.transpose() * x.col(constraint.node);
    at += constraint.directions.cols();
  }
  return part;
}

/// Inertia of the bordered matrix [K B; B^T 0]: that of K and of the Schur complement -C; the
/// border itself adds m positive and m negative eigenvalues [Haynsworth 1968].
void Linearisation::border(Inertia& inertia) {
  border_.clear();
  for (const Constraint& constraint : constraints_)
    for (Eigen::Index k = 0; k < constraint.directions.cols(); ++k) {
      border_.push_back(Eigen::Matrix3Xd::Zero(3, model_.columns()));
      border_.back().col(constraint.node) = constraint.directions.col(k);
      solver_->solve(border_.back());
    }
  const Eigen::Index m = Eigen::Index(border_.size());
  compliance_.resize(m, m);
  for (Eigen::Index k = 0; k < m; ++k)
    compliance_.col(k) = constrained_part(border_[std::size_t(k)]);
  compliance_ = (0.5 * (compliance_ + compliance_.transpose())).eval();
  const Eigen::VectorXd own = eigenvalues(compliance_);
  inertia.usable = own.allFinite() && (own.array() != 0).all();
  inertia.negative_pivots += int((own.array() > 0).count()) - int(m);
}

void Linearisation::solve(Eigen::Matrix3Xd& right_hand_side) const {
  if (!solver_->has_factor()) {
    ++effort_.factorizations;
    solver_->factor(assembly_.hessian, shift_);
  }
  model_.fold(right_hand_side);
  solver_->solve(right_hand_side);
  if (!constraints_.empty()) {
    const Eigen::VectorXd force = solution(compliance_, constrained_part(right_hand_side));
    for (std::size_t k = 0; k < border_.size(); ++k)
      right_hand_side -= force[Eigen::Index(k)] * border_[k];
  }
  model_.follow(right_hand_side);
}

Eigen::MatrixXd Linearisation::constraint_stiffness() const {
  Eigen::MatrixXd stiffness = inverse(compliance_);
  stiffness.diagonal().array() -= border_stiffness;
  return stiffness;
}

double Linearisation::residual() const {
  if (constraints_.empty()) return residual_of(model_, assembly_.gradient);
  Eigen::Matrix3Xd unconstrained = assembly_.gradient;
  for (const Constraint& constraint : constraints_)
    unconstrained.col(constraint.node) -= constraint.part(reaction(constraint));
  return residual_of(model_, unconstrained);
}

void Linearisation::residual_at(const State& state) {
  assemble_mixed_residual(model_, state, outside, tangents_, assembly_, solver_->team);
}

void Linearisation::gradient_at(const State& state) {
  assemble_gradient(model_, state, outside, assembly_, solver_->team);
}

void Linearisation::correction(Eigen::Matrix3Xd& dx) const {
  dx = -assembly_.gradient;
  solve(dx);
}

void Linearisation::tangent(const Eigen::Matrix3Xd& prescribed,
                            const ExternalLoads& outside_velocity, const State& state,
                            Eigen::Matrix3Xd& velocity) const {
  Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, model_.columns());
  for (int column = 0; column < model_.nodes; ++column)
    if (model_.pinned(column)) moved.col(column) = prescribed.col(column);
  for (const Constraint& constraint : constraints_)
    moved.col(constraint.node) = constraint.part(prescribed.col(constraint.node));
  multiply(model_, assembly_.hessian, moved, velocity);
  velocity *= -1;
  const auto grow = [&](const std::vector<NodeAction>& actions, double factor) {
    for (const NodeAction& action : actions) action.add_gradient(-factor, state.x, velocity);
  };
  if (outside_velocity.load != 0) grow(model_.loads, outside_velocity.load);
  if (outside_velocity.field && outside_velocity.field_factor != 0)
    grow(*outside_velocity.field, outside_velocity.field_factor);
  if (outside_velocity.opening != 0)
    velocity -= outside_velocity.opening * opening_rate(model_, tangents_);
  solve(velocity);
  velocity += moved;
  model_.follow(velocity);
}

Eigen::VectorXd Linearisation::force_change(const Eigen::Matrix3Xd& dx, double opening) const {
  Eigen::VectorXd change(model_.forces());
  for (std::size_t k = 0; k < model_.edges.size(); ++k) {
    const ModelEdge& edge = model_.edges[k];
    change[Eigen::Index(k)] =
        EA_scale_ * edge.EA / edge.rest_length *
        tangents_.col(Eigen::Index(k)).dot(dx.col(edge.to) - dx.col(edge.from));
  }
  each_spring(model_, [&](const auto& pair, Eigen::Index index) {
    double angle = -opening * pair.law.opening;
    each_arm(model_, pair, index, [&](const ModelEdge& edge, Eigen::Index column) {
      angle += tangents_.col(column).dot(dx.col(edge.to) - dx.col(edge.from));
    });
    change[index] = angle;
  });
  const Eigen::Index springs = model_.forces() - Eigen::Index(model_.edges.size());
  change.tail(springs) = spring_torques(model_, change.tail(springs));
  return change;
}

bool Linearisation::forces_agree(const State& state, double fraction) const {
  double largest = 0;
  for (std::size_t k = 0; k < model_.edges.size(); ++k)
    largest = std::max(largest, std::abs(EA_scale_ * force_of_strain(model_.edges[k], state.x) -
                                         state.force[Eigen::Index(k)]));
  return largest <=
         fraction * state.force.head(Eigen::Index(model_.edges.size())).cwiseAbs().maxCoeff();
}

void Linearisation::apply(const Eigen::Matrix3Xd& dx, State& state, double fraction) const {
  if (fraction < 1) {
    const Eigen::VectorXd force = state.force;
    apply(fraction * dx, state);
    state.force += (1 - fraction) * (force - assembly_.force);
    return;
  }
  state.force = assembly_.force + force_change(dx);
  move_to(model_, state.x + dx, state);
}

void Linearisation::restore_lengths(const Eigen::VectorXd& force, State& state) const {
  Eigen::Matrix3Xd pull = Eigen::Matrix3Xd::Zero(3, model_.columns());
  for (std::size_t k = 0; k < model_.edges.size(); ++k) {
    const ModelEdge& edge = model_.edges[k];
    const double excess = EA_scale_ * force_of_strain(edge, state.x) - force[Eigen::Index(k)];
    pull.col(edge.from) += excess * tangents_.col(Eigen::Index(k));
    pull.col(edge.to) -= excess * tangents_.col(Eigen::Index(k));
  }
  const Eigen::VectorXd torques =
      spring_torques(model_, spring_excess(model_, state, outside.opening));
  each_spring(model_, [&](const auto& pair, Eigen::Index index) {
    const double excess = torques[index - Eigen::Index(model_.edges.size())] - force[index];
    each_arm(model_, pair, index, [&](const ModelEdge& edge, Eigen::Index column) {
      pull.col(edge.from) += excess * tangents_.col(column);
      pull.col(edge.to) -= excess * tangents_.col(column);
    });
  });
  solve(pull);
  move_to(model_, state.x + pull, state);
}

double max_column_norm(const Eigen::Matrix3Xd& dx) {
  double largest = 0;
  for (Eigen::Index k = 0; k < dx.cols(); ++k) {
    const double size = dx.col(k).squaredNorm();
    if (!(size <= largest)) largest = size;  // a nan is kept, not hidden
  }
  return std::sqrt(largest);
}

namespace {

/// L v over all columns.
Eigen::Matrix3Xd weighted(const Eigen::Matrix3Xd& v, const Eigen::VectorXd& length) {
  Eigen::Matrix3Xd product = Eigen::Matrix3Xd::Zero(3, v.cols());
  product.leftCols(length.size()) = v.leftCols(length.size()) * length.asDiagonal();
  return product;
}

}  // namespace

double lowest_eigenvalue(Linearisation& system, const State& state, const Eigen::VectorXd& length,
                         const Watch& watch, double converged) {
  if (!system.at(state, false).positive_definite()) return std::numeric_limits<double>::quiet_NaN();
  Eigen::Matrix3Xd mode;
  return lowest_eigenvalue(system, length, mode, watch, converged);
}

double lowest_eigenvalue(Linearisation& system, const Eigen::VectorXd& length, Eigen::Matrix3Xd& v,
                         const Watch& watch, double converged) {
  constexpr int most_iterations = 200;
  // the start has a component along every mode: a former lowest mode has none along modes of
  // another symmetry, which need some iterations to grow
  const int least_iterations = v.size() == 0 ? 0 : 5;
  Eigen::Matrix3Xd any(3, system.model().columns());
  for (Eigen::Index k = 0; k < any.size(); ++k) any.data()[k] = std::sin(1 + 1.7 * double(k));
  v = v.size() == 0 ? any : Eigen::Matrix3Xd(v / v.norm() + any / any.norm());
  double lambda = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most_iterations && !watch.cancelled(); ++k) {
    Eigen::Matrix3Xd next = weighted(v, length);
    const Eigen::Matrix3Xd force = next;
    system.solve(next);
    // Rayleigh's quotient of the new vector: H next = force
    const double before =
        std::exchange(lambda, product(next, force) / product(next, weighted(next, length)));
    v = next / next.norm();
    if (k >= least_iterations && std::abs(before - lambda) <= converged * lambda) break;
  }
  return watch.cancelled() ? std::numeric_limits<double>::quiet_NaN() : lambda;
}

namespace {

/// Predicts the next correction, 8 m^2/l, from a correction m with a new factorisation. Over
/// thirteen presets of all kinds half of the next corrections were below m^2/l; nine in ten were
/// below 5 m^2/l except for three presets. Near a snap the prediction was a hundred times too
/// small; the remaining error is then still below a tenth of the accuracy that tolerances are
/// chosen for.
class NextCorrection {
 public:
  explicit NextCorrection(const Model& model) {
    double sum = 0;
    for (const ModelEdge& edge : model.edges) sum += edge.rest_length;
    by_square_ = 8 * double(model.edges.size()) / sum;
    // the force of a contact barrier changes over a fraction of its gap
    if (model.contact.any()) by_square_ = std::max(by_square_, 8 / model.contact.barrier.gap_mm);
  }
  double after(double move) const { return by_square_ * move * move; }

 private:
  double by_square_;
};

}  // namespace

NewtonReport newton(Linearisation& system, State& state, const NewtonOptions& options,
                    const Watch& watch) {
  NewtonReport report;
  Eigen::Matrix3Xd dx;
  const auto end = [&](Outcome outcome) {
    report.outcome = outcome;
    return report;
  };
  const NextCorrection next_move(system.model());
  bool factor = true;
  double before = 0;
  for (report.iterations = 1; report.iterations <= options.most_iterations; ++report.iterations) {
    if (watch.cancelled()) return end(Outcome::cancelled);
    if (factor) {
      report.inertia = system.at(state);
    } else {
      system.residual_at(state);
    }
    ++system.effort().newton_iterations;
    if (!std::isfinite(system.assembly().energies.total())) return end(Outcome::not_finite);
    if (system.assembly().smallest_cosine < options.widest_turn) return end(Outcome::folded);
    if (!report.inertia.usable) return end(Outcome::not_finite);
    system.correction(dx);
    const double move = max_column_norm(dx);
    if (!std::isfinite(move)) return end(Outcome::not_finite);
    if (report.iterations == 1) report.first_move_mm = move;
    // corrections that double after the first iterations diverge
    if (report.iterations > 4 && move > 2 * before && move > 100 * options.tolerance_mm)
      return end(Outcome::lost);
    if (move > options.farthest_mm) return end(Outcome::lost);
    system.apply(dx, state, system.clear_fraction(state, dx));
    report.last_move_mm = move;
    report.factored_move_mm = factor ? move : report.factored_move_mm + move;
    // overlapping rods are in equilibrium where their axes cross, but the shell is not
    if (system.assembly().overlap) {
      factor = true;
      before = move;
      if (move <= options.tolerance_mm) return end(Outcome::lost);
      continue;
    }
    const auto forces_agree = [&] {
      return !options.trusted_misfit || system.forces_agree(state, *options.trusted_misfit);
    };
    if (move <= options.tolerance_mm) return end(Outcome::reached);
    if (factor && next_move.after(move) <= options.trusted_mm && forces_agree())
      return end(Outcome::reached);
    // an old factorisation is used near the end only, and while corrections decrease tenfold
    const bool near = move < options.near_mm;
    factor = !near || (!factor && move > 0.1 * before);
    before = move;
  }
  return report;
}

}  // namespace gridshell
