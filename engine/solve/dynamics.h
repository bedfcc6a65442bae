// Motion in time: a moving state and its mass.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/elastic/state.h"
#include "engine/solve/newton.h"

namespace gridshell {

// Units are mm, N, s; with a mass in tonnes (1 t = 1000 kg) N = t mm/s^2.

/// Lumped masses, one per unknown: a node has half the mass of each edge at the node, an angle the
/// edge's inertia about its axis. `mass_t_per_mm`: one per rod, or one for all; `on_nodes`:
/// additional mass of the first nodes. Errors (bad_input): a rod without mass.
Result<Eigen::Matrix3Xd> lumped_mass(const Model& model, const std::vector<double>& mass_t_per_mm,
                                     const Eigen::RowVectorXd& on_nodes = {});

/// Mass per length of a round rod, t/mm: density * pi/4 D^2.
double round_mass_t_per_mm(double density_kg_m3, double diameter_mm);

struct MovingState {
  State state;
  Eigen::Matrix3Xd velocity;  ///< velocity of every column, mm/s
  double time = 0;            ///< s

  static MovingState at_rest(State state);
};

struct DynamicsOptions {
  double step_s = 1e-3;
  double damping_per_s = 0;    ///< mass-proportional: force -damping * mass * velocity
  double tolerance_mm = 1e-9;  ///< largest move in the last correction of a step
  int most_iterations = 30;
};

/// 1/2 sum m v^2, mJ.
double kinetic_energy(const Eigen::Matrix3Xd& mass, const MovingState& moving);

// Motion in time until equilibrium: a snap.

/// Criterion for equilibrium, and the longest time until it.
struct RestOptions {
  double still_N = 1e-5;    ///< largest force of the shell, inertia not counted
  double still_mJ = 1e-10;  ///< kinetic energy
  double longest_s = 60;
};

/// TR-BDF2 with mass-proportional damping [Bank et al. 1985]: the trapezoidal rule over gamma h,
/// then the two-step backward formula up to h, gamma = 2 - sqrt 2. Both parts have the same matrix
/// d^2E/dx^2 + m (1/w^2 + c/w), w = (1 - 1/sqrt 2) h. The method is of second order and L-stable:
/// oscillations faster than the step are damped at once, whereas the midpoint rule would preserve
/// them.
class DampedMotion {
 public:
  /// `constraints` as in Linearisation; a mass a million times the shell's fixes their components.
  DampedMotion(const Model& model, Eigen::Matrix3Xd mass, const DynamicsOptions& options,
               const ExternalLoads& outside = {}, std::vector<Constraint> constraints = {});

  /// Takes one step. Returns false if that fails or is cancelled; then the motion is unchanged.
  bool step(MovingState& moving, const Watch& watch = unwatched);

  /// Steps until equilibrium. A step that fails is halved; successful steps grow again. `seen` is
  /// called after each. Errors: no_equilibrium (time exceeded or a step too small), cancelled.
  Result<void> settle(MovingState& moving, const RestOptions& rest,
                      const std::function<void(const MovingState&)>& seen, const Watch& watch);

  double step_s() const { return options_.step_s; }
  /// Largest force of the shell at a state, inertia not counted, N.
  double residual(const State& state);

 private:
  bool implicit(const Eigen::Matrix3Xd& aim, const Eigen::Matrix3Xd& force, double stiffness,
                State& state, const Watch& watch);
  Eigen::Matrix3Xd forces(const State& state);
  void clear_prescribed(Eigen::Matrix3Xd& v) const;

  const Model& model_;
  Eigen::Matrix3Xd mass_;
  double whole_mass_ = 0;
  DynamicsOptions options_;
  ExternalLoads outside_;
  std::vector<Constraint> constraints_;
  std::unique_ptr<LinearSolver> solver_;
  Assembly assembly_;
};

}  // namespace gridshell
