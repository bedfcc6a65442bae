// Motion in time: a moving state and its mass.
#pragma once

#include <Eigen/Core>

#include "engine/core/result.h"
#include "engine/gridshell/state.h"

namespace gridshell {

/// Units: mm, N, s; a mass in tonnes (1 t = 1000 kg) makes N = t mm/s^2.
/// Lumped masses, one an unknown: a node has half the mass of each edge that meets there, an angle
/// the edge's inertia about its axis. `mass_t_per_mm`: one a rod, or one for all. Errors
/// (bad_input): a rod without mass.
Result<Eigen::Matrix3Xd> lumped_mass(const Model& model, const std::vector<double>& mass_t_per_mm);

/// Mass of a round rod a length, t/mm: density * pi/4 D^2.
double round_mass_t_per_mm(double density_kg_m3, double diameter_mm);

struct MovingState {
  State state;
  Eigen::Matrix3Xd velocity;  ///< of every column, mm/s
  double time = 0;            ///< s

  static MovingState at_rest(State state) {
    Eigen::Matrix3Xd still = Eigen::Matrix3Xd::Zero(3, state.x.cols());
    return {std::move(state), std::move(still), 0};
  }
};

struct DynamicsOptions {
  double step_s = 1e-3;
  double damping_per_s = 0;    ///< mass-proportional: force -damping * mass * velocity
  double tolerance_mm = 1e-9;  ///< of Newton's corrections in a step
  int most_iterations = 30;
};

/// 1/2 sum m v^2, mJ.
double kinetic_energy(const Eigen::Matrix3Xd& mass, const MovingState& moving);

}  // namespace gridshell
