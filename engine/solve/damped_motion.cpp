#include "engine/solve/damped_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gridshell {
namespace {

constexpr double gamma = 2 - M_SQRT2;  // share of the trapezoidal part
constexpr double held_mass = 1e6;      // of what is prescribed, over the shell's

}  // namespace

DampedMotion::DampedMotion(const Model& model, Eigen::VectorXd mass, const DynamicsOptions& options,
                           const Prescription& prescription, double load)
    : model_(model),
      mass_(std::move(mass)),
      whole_mass_(mass_.sum()),
      options_(options),
      prescription_(prescription),
      load_(load),
      solver_(make_linear_solver(model)) {}

/// force of the shell and its loads on the free nodes, none along what is prescribed
Eigen::Matrix3Xd DampedMotion::forces(const Eigen::Matrix3Xd& x) {
  assemble_gradient(model_, x, assembly_);
  add_loads(model_, x, load_, assembly_);
  Eigen::Matrix3Xd force = -assembly_.gradient;
  for (int node = 0; node < model_.nodes; ++node)
    if (model_.pinned[std::size_t(node)]) force.col(node).setZero();
  if (prescription_.active())
    force.col(prescription_.node) -= prescription_.part(force.col(prescription_.node));
  return force;
}

double DampedMotion::residual(const Eigen::Matrix3Xd& x) { return largest_column(forces(x)); }

/// Newton's method for dE/dx + stiffness m (x - aim) = force, from x.
bool DampedMotion::implicit(const Eigen::Matrix3Xd& aim, const Eigen::Matrix3Xd& force,
                            double stiffness, Eigen::Matrix3Xd& x) {
  Eigen::Matrix3Xd dx;
  for (int iteration = 0; iteration < options_.most_iterations; ++iteration) {
    assemble_hessian(model_, x, nullptr, 1, assembly_);
    add_loads(model_, x, load_, assembly_);
    if (!std::isfinite(assembly_.energies.total()) || assembly_.largest_turn < -0.9) return false;
    dx = force - assembly_.gradient;
    for (int node : model_.free_nodes) {
      const double own = stiffness * mass_[node];
      assembly_.hessian.diagonal[std::size_t(node)].diagonal().array() += own;
      dx.col(node) -= own * (x.col(node) - aim.col(node));
    }
    if (prescription_.active()) {
      const Eigen::Matrix3Xd& held = prescription_.directions;
      const int node = prescription_.node;
      assembly_.hessian.diagonal[std::size_t(node)] +=
          stiffness * held_mass * whole_mass_ * held * held.transpose();
      dx.col(node) -= prescription_.part(dx.col(node));
    }
    if (!solver_->factor(assembly_.hessian, 0).usable) return false;
    solver_->solve(dx);
    if (prescription_.active())
      dx.col(prescription_.node) -= prescription_.part(dx.col(prescription_.node));
    const double move = largest_column(dx);
    if (!std::isfinite(move)) return false;
    x += dx;
    if (move <= options_.tolerance_mm) return true;
  }
  return false;
}

bool DampedMotion::step(Motion& motion) {
  const double h = options_.step_s, c = options_.damping_per_s;
  const double w = (1 - M_SQRT1_2) * h, stiffness = 1 / (w * w) + c / w;
  const auto times_mass = [&](const Eigen::Matrix3Xd& v) -> Eigen::Matrix3Xd {
    return v * mass_.asDiagonal();
  };
  const Eigen::Matrix3Xd &x0 = motion.x, &v0 = motion.velocity;

  // m ((x1 - x0)/w^2 - 2 v0/w) + c m (x1 - x0)/w = F(x0) + F(x1)
  Eigen::Matrix3Xd x1 = x0 + gamma * h * v0;
  if (!implicit(x0, forces(x0) + times_mass(2 / w * v0), stiffness, x1)) return false;
  const Eigen::Matrix3Xd v1 = (x1 - x0) / w - v0;

  // x2 = X + w v2, v2 = V + w a2
  const double a = 1 / (gamma * (2 - gamma)), b = (1 - gamma) * (1 - gamma) * a;
  const Eigen::Matrix3Xd X = a * x1 - b * x0, V = a * v1 - b * v0;
  Eigen::Matrix3Xd x2 = x1 + (1 - gamma) * h * v1;
  for (int node = 0; node < model_.nodes; ++node)
    if (model_.pinned[std::size_t(node)]) x2.col(node) = x1.col(node) = x0.col(node);
  if (!implicit(X, times_mass(V / w), stiffness, x2)) return false;
  motion.velocity = (x2 - X) / w;
  for (int node = 0; node < model_.nodes; ++node)
    if (model_.pinned[std::size_t(node)]) motion.velocity.col(node).setZero();
  motion.x = std::move(x2);
  motion.time += h;
  return true;
}

Result<void> DampedMotion::settle(Motion& motion, const RestOptions& rest,
                                  const std::function<void(const Motion&)>& seen,
                                  const Watch& watch) {
  const double wanted = options_.step_s, end = motion.time + rest.longest_s;
  struct Back {  // the step asked for stays that of the next motion
    double& step;
    double wanted;
    ~Back() { step = wanted; }
  } back{options_.step_s, wanted};
  while (motion.time < end) {
    if (watch.cancelled()) return fail(Fault::cancelled, "stopped while a snap came to rest");
    if (!step(motion)) {
      options_.step_s /= 2;
      if (options_.step_s < 1e-6 * wanted)
        return fail(Fault::no_equilibrium,
                    fmt::format("no time step however small succeeds at {:.4g} s", motion.time));
      continue;
    }
    options_.step_s = std::min(wanted, 2 * options_.step_s);
    if (seen) seen(motion);
    if (kinetic_energy(mass_, motion) < rest.still_mJ && residual(motion.x) < rest.still_N)
      return {};
  }
  return fail(Fault::no_equilibrium,
              fmt::format("not at rest after {:.4g} s, kinetic energy {:.2g} mJ", rest.longest_s,
                          kinetic_energy(mass_, motion)));
}

}  // namespace gridshell
