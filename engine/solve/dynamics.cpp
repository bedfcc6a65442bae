#include "engine/solve/dynamics.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/solve/newton.h"

namespace gridshell {

Result<Eigen::VectorXd> lumped_masses(const Model& model, double density_kg_m3,
                                      double diameter_mm) {
  if (!(density_kg_m3 > 0))
    return fail(Fault::bad_input,
                fmt::format("density {} kg/m^3: dynamics needs a mass, above 0", density_kg_m3));
  if (!(diameter_mm > 0))
    return fail(Fault::bad_input, fmt::format("diameter {} mm: must be above 0", diameter_mm));
  // 1 kg/m^3 = 1e-12 t/mm^3
  const double per_mm = 1e-12 * density_kg_m3 * M_PI * diameter_mm * diameter_mm / 4;
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(model.nodes);
  for (const ModelEdge& edge : model.edges)
    for (int node : {edge.from, edge.to}) mass[node] += 0.5 * per_mm * edge.rest_length;
  return mass;
}

double kinetic_energy(const Eigen::VectorXd& mass, const Motion& motion) {
  return 0.5 * motion.velocity.colwise().squaredNorm().dot(mass.transpose());
}

ImplicitDynamics::ImplicitDynamics(const Model& model, Eigen::VectorXd mass,
                                   const DynamicsOptions& options)
    : model_(model),
      mass_(std::move(mass)),
      options_(options),
      solver_(make_linear_solver(model)) {}

bool ImplicitDynamics::step(Motion& motion) {
  const double h = options_.step_s, c = options_.damping_per_s;
  // the unknown is the half step y = (x0 + x1)/2: dE/dx(y) + m (4/h^2 + 2c/h) (y - x0) = 2/h m v0
  const double inertia = 4 / (h * h) + 2 * c / h;
  Eigen::Matrix3Xd y = motion.x + 0.5 * h * motion.velocity, dy;
  for (int iteration = 0; iteration < options_.most_iterations; ++iteration) {
    assemble_hessian(model_, y, nullptr, 1, assembly_);
    if (!std::isfinite(assembly_.energies.total()) || assembly_.largest_turn < -0.9) return false;
    dy = -assembly_.gradient;
    for (int node : model_.free_nodes) {
      assembly_.hessian.diagonal[node].diagonal().array() += inertia * mass_[node];
      dy.col(node) += mass_[node] * (2 / h * motion.velocity.col(node) -
                                     inertia * (y.col(node) - motion.x.col(node)));
    }
    if (!solver_->factor(assembly_.hessian, 0).usable) return false;
    solver_->solve(dy);
    const double move = largest_column(dy);
    if (!std::isfinite(move)) return false;
    y += dy;
    if (move > options_.tolerance_mm) continue;
    motion.velocity = 4 / h * (y - motion.x) - motion.velocity;
    motion.x = 2 * y - motion.x;
    // a pinned node moves evenly: its velocity stays what it is
    motion.time += h;
    return true;
  }
  return false;
}

}  // namespace gridshell
