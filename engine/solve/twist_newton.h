// Equilibria on the twist rung: shifted Newton with line search from far, full steps near.
#pragma once

#include "engine/core/watch.h"
#include "engine/gridshell/twist_model.h"
#include "engine/solve/newton.h"
#include "engine/solve/sparse_ldl.h"

namespace gridshell {

struct TwistOptions {
  double tolerance_mm = 1e-8;  ///< converged when a full step moves no unknown further
  int most_iterations = 500;
  double largest_move_mm = 0;  ///< a step is cut to it; 0: an edge length
  bool saddles = false;        ///< plain Newton: whatever equilibrium is near, stable or not
  double widest_turn = -0.5;   ///< edges that turn further than this cosine have folded
};

/// Newton's method on one model. Angles count in mm over the mean edge length, in moves and shifts.
class TwistSolver {
 public:
  explicit TwistSolver(const TwistModel& model);

  /// Brings `state` to rest, held unknowns as they are. The Hessian is shifted until it is positive
  /// definite and the energy falls at every step: ends at a minimum, or with `saddles` at the
  /// nearest equilibrium. On failure the state is the last iterate and the report says why.
  NewtonReport rest(TwistState& state, const TwistOptions& options, const Watch& watch);

  /// Inertia of the energy's Hessian at a state; positive definite: stable.
  Inertia inertia_at(const TwistState& state);
  /// Softest mode of the Hessian at a state by inverse iteration, a unit vector over all unknowns.
  Eigen::VectorXd softest_mode(const TwistState& state);
  /// How all unknowns follow when held nodes move with `held` (3 x nodes; of free ones ignored) and
  /// the load factor grows by `load`, with the factorisation that rest() left; frames are carried.
  Eigen::VectorXd velocity(const TwistState& state, const Eigen::Matrix3Xd& held, double load);
  /// Moves the free unknowns by `step` (over all unknowns).
  void apply(const Eigen::VectorXd& step, double factor, TwistState& state) const;

  /// Largest force on a free unknown at a state, N (moments over the mean edge length).
  double residual_at(const TwistState& state) {
    assembly_.gradient_at(state);
    return residual();
  }
  const TwistAssembly& assembly() const { return assembly_; }
  double residual() const;  ///< largest force on a free node, N, of the last assembly
  const Effort& effort() const { return effort_; }

 private:
  Inertia factor(double shift);
  Eigen::VectorXd correction() const;
  double move_of(const Eigen::VectorXd& step) const;

  const TwistModel& model_;
  TwistAssembly assembly_;
  SparseLdl ldl_;
  double length_ = 1;       // mean edge, mm
  Eigen::VectorXd weight_;  // of the shift: 1 for positions, length^2 for angles
  Effort effort_;
};

}  // namespace gridshell
