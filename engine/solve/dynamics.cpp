#include "engine/solve/dynamics.h"
#include "engine/elastic/model.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace gridshell {

double round_mass_t_per_mm(double density_kg_m3, double diameter_mm) {
  // 1 kg/m^3 = 1e-12 t/mm^3
  return 1e-12 * density_kg_m3 * M_PI * diameter_mm * diameter_mm / 4;
}

Result<Eigen::Matrix3Xd> lumped_mass(const Model& model, const std::vector<double>& mass_t_per_mm,
                                     const Eigen::RowVectorXd& on_nodes) {
  for (double mass : mass_t_per_mm)
    if (!(mass > 0))
      return fail(Fault::bad_input, fmt::format("{} t/mm: motion in time needs a mass of all rods, "
                                                "expected [rod] density_kg_m3 above 0",
                                                mass));
  Eigen::Matrix3Xd mass = Eigen::Matrix3Xd::Zero(3, model.columns());
  mass.leftCols(on_nodes.size()).rowwise() += on_nodes;
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    const double per_mm = mass_t_per_mm.size() == 1 ? mass_t_per_mm[0] : mass_t_per_mm[r];
    for (int edge : model.rods[r].edges) {
      const ModelEdge& e = model.edges[std::size_t(edge)];
      const double own = per_mm * e.rest_length;
      if (model.has_spins())
        mass.data()[model.spin[std::size_t(edge)]] +=
            own * model.rods[r].gyration_mm2 / (model.spin_length * model.spin_length);
      if (e.EA == 0) continue;  // a ghost shows a direction and weighs nothing
      for (int node : {e.from, e.to}) mass.col(node).array() += 0.5 * own;
    }
  }
  for (const ModelFollower& one : model.followers) {
    mass.col(one.centre) += mass.col(one.node);
    mass.col(one.node).setZero();
  }
  return mass;
}

double kinetic_energy(const Eigen::Matrix3Xd& mass, const MovingState& moving) {
  return 0.5 * (mass.array() * moving.velocity.array().square()).sum();
}

namespace {

constexpr double gamma = 2 - M_SQRT2;     // fraction of the trapezoidal part
constexpr double constrained_mass = 1e6;  // mass of prescribed components, over the shell's mass

}  // namespace

MovingState MovingState::at_rest(State state) {
  Eigen::Matrix3Xd still = Eigen::Matrix3Xd::Zero(3, state.x.cols());
  return {std::move(state), std::move(still), 0};
}

DampedMotion::DampedMotion(const Model& model, Eigen::Matrix3Xd mass,
                           const DynamicsOptions& options, const ExternalLoads& outside,
                           std::vector<Constraint> constraints)
    : model_(model),
      mass_(std::move(mass)),
      whole_mass_(mass_.row(0).leftCols(model.nodes).sum()),
      options_(options),
      outside_(outside),
      constraints_(std::move(constraints)),
      solver_(make_linear_solver(model)) {}

void DampedMotion::clear_prescribed(Eigen::Matrix3Xd& v) const {
  clear_fixed(model_, v);
  for (const Constraint& constraint : constraints_)
    v.col(constraint.node) -= constraint.part(v.col(constraint.node));
}

/// Forces of the shell and its loads on free components; zero on prescribed ones.
Eigen::Matrix3Xd DampedMotion::forces(const State& state) {
  assemble_gradient(model_, state, outside_, assembly_);
  Eigen::Matrix3Xd force = -assembly_.gradient;
  clear_prescribed(force);
  return force;
}

double DampedMotion::residual(const State& state) { return max_column_norm(forces(state)); }

/// Newton's method for dE/dx + stiffness m (x - aim) = force, from the state.
bool DampedMotion::implicit(const Eigen::Matrix3Xd& aim, const Eigen::Matrix3Xd& force,
                            double stiffness, State& state, const Watch& watch) {
  Eigen::Matrix3Xd dx;
  for (int iteration = 0; iteration < options_.most_iterations; ++iteration) {
    if (watch.cancelled()) return false;
    assemble_hessian(model_, state, outside_, {}, assembly_);
    if (!std::isfinite(assembly_.energies.total()) || assembly_.smallest_cosine < -0.9)
      return false;
    dx = force - assembly_.gradient - stiffness * mass_.cwiseProduct(state.x - aim);
    for (int column : model_.free_columns)
      assembly_.hessian.diagonal[std::size_t(column)].matrix().diagonal() +=
          stiffness * mass_.col(column);
    for (const Constraint& constraint : constraints_)
      assembly_.hessian.diagonal[std::size_t(constraint.node)].matrix() +=
          stiffness * constrained_mass * whole_mass_ * constraint.directions *
          constraint.directions.transpose();
    clear_prescribed(dx);
    if (!solver_->factor(assembly_.hessian, 0).usable) return false;
    solver_->solve(dx);
    clear_prescribed(dx);
    const double move = max_column_norm(dx);
    if (!std::isfinite(move)) return false;
    move_to(model_, state.x + dx, state);
    if (move <= options_.tolerance_mm) return true;
  }
  return false;
}

bool DampedMotion::step(MovingState& moving, const Watch& watch) {
  const double h = options_.step_s, c = options_.damping_per_s;
  const double w = (1 - M_SQRT1_2) * h, stiffness = 1 / (w * w) + c / w;
  const Eigen::Matrix3Xd &x0 = moving.state.x, &v0 = moving.velocity;
  const auto predicted = [&](const State& from, const Eigen::Matrix3Xd& by) {
    Eigen::Matrix3Xd free = by;
    clear_fixed(model_, free);
    State state = from;
    move_to(model_, from.x + free, state);
    return state;
  };

  // m ((x1 - x0)/w^2 - 2 v0/w) + c m (x1 - x0)/w = F(x0) + F(x1)
  State first = predicted(moving.state, gamma * h * v0);
  if (!implicit(x0, forces(moving.state) + mass_.cwiseProduct(2 / w * v0), stiffness, first, watch))
    return false;
  const Eigen::Matrix3Xd& x1 = first.x;
  const Eigen::Matrix3Xd v1 = (x1 - x0) / w - v0;

  // x2 = X + w v2, v2 = V + w a2
  const double a = 1 / (gamma * (2 - gamma)), b = (1 - gamma) * (1 - gamma) * a;
  const Eigen::Matrix3Xd X = a * x1 - b * x0, V = a * v1 - b * v0;
  State second = predicted(first, (1 - gamma) * h * v1);
  if (!implicit(X, mass_.cwiseProduct(V / w), stiffness, second, watch)) return false;
  moving.velocity = (second.x - X) / w;
  clear_fixed(model_, moving.velocity);
  moving.state = std::move(second);
  moving.time += h;
  return true;
}

Result<void> DampedMotion::settle(MovingState& moving, const RestOptions& rest,
                                  const std::function<void(const MovingState&)>& seen,
                                  const Watch& watch) {
  const double requested = options_.step_s, end = moving.time + rest.longest_s;
  struct Back {  // restores the requested step for the next motion
    double& step;
    double requested;
    ~Back() { step = requested; }
  } back{options_.step_s, requested};
  while (moving.time < end) {
    if (watch.cancelled()) return fail(Fault::cancelled, "stopped during a snap");
    if (!step(moving, watch)) {
      options_.step_s /= 2;
      if (options_.step_s < 1e-6 * requested)
        return fail(Fault::no_equilibrium,
                    fmt::format("no time step however small succeeds at {:.4g} s", moving.time));
      continue;
    }
    options_.step_s = std::min(requested, 2 * options_.step_s);
    if (seen) seen(moving);
    if (kinetic_energy(mass_, moving) < rest.still_mJ && residual(moving.state) < rest.still_N)
      return {};
  }
  return fail(Fault::no_equilibrium,
              fmt::format("not in equilibrium after {:.4g} s, kinetic energy {:.2g} mJ",
                          rest.longest_s, kinetic_energy(mass_, moving)));
}

}  // namespace gridshell
