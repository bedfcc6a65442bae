// Motion in time on the `bend` rung: the same energies with mass and damping.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "engine/core/result.h"
#include "engine/gridshell/model.h"
#include "engine/solve/linear_solver.h"

namespace gridshell {

/// Units: mm, N, s; a mass in tonnes (1 t = 1000 kg) makes N = t mm/s^2.
/// Lumped masses, one a node: half the mass of each edge that meets there, density * area * rest
/// length. Errors (bad_input): density or area that is not positive.
Result<Eigen::VectorXd> lumped_masses(const Model& model, double density_kg_m3, double diameter_mm);

struct Motion {
  Eigen::Matrix3Xd x;         ///< mm
  Eigen::Matrix3Xd velocity;  ///< mm/s
  double time = 0;            ///< s
};

struct DynamicsOptions {
  double step_s = 1e-3;
  double damping_per_s = 0;    ///< mass-proportional: force -damping * mass * velocity
  double tolerance_mm = 1e-9;  ///< of Newton's corrections in a step
  int most_iterations = 30;
};

/// 1/2 sum m v^2, mJ.
double kinetic_energy(const Eigen::VectorXd& mass, const Motion& motion);

/// The implicit midpoint rule, m (v1 - v0)/h = F((x0 + x1)/2) - c m (v0 + v1)/2, (x1 - x0)/h =
/// (v0 + v1)/2: second order, symplectic; without damping the energy has no drift. Pinned nodes
/// stay, or move with their velocity.
class ImplicitDynamics {
 public:
  ImplicitDynamics(const Model& model, Eigen::VectorXd mass, const DynamicsOptions& options);

  /// One step; on failure (false) the motion is unchanged.
  bool step(Motion& motion);

  void set_step(double step_s) { options_.step_s = step_s; }
  const Energies& energies() const { return assembly_.energies; }  ///< at the last midpoint

 private:
  const Model& model_;
  Eigen::VectorXd mass_;
  DynamicsOptions options_;
  std::unique_ptr<LinearSolver> solver_;
  Assembly assembly_;
};

}  // namespace gridshell
