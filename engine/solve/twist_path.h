// Following an equilibrium of the twist rung while what holds its ends moves.
#pragma once

#include "engine/solve/path.h"
#include "engine/solve/twist_newton.h"

namespace gridshell {

/// How a step along the path ended.
enum class TwistPathEnd { reached, jumped, not_finite, cancelled };

/// Predictor and corrector on one model: the tangent of the path and its change predict, Newton's
/// method with the energy's exact Hessian corrects. Between two accepted points the correction is a
/// small part of the move predicted, and each is a minimum of the energy (or, with
/// allow_unstable(), an equilibrium whose negative pivots are counted).
class TwistPath {
 public:
  /// `motion` in the model's numbers.
  TwistPath(const TwistModel& model, const PinnedMotion& motion, const PathOptions& options);

  /// Comes to rest at t from the nodes at `x` (those that are held go where they belong); `flat`
  /// are the positions at which no rod is bent and every director stands up: what a clamped end
  /// holds is the director carried from there. False when there is no rest.
  bool start(double t, const Eigen::Matrix3Xd& flat, const Eigen::Matrix3Xd& x, const Watch& watch);

  /// Follows the path to t, forwards or backwards. On `jumped` no step however small finds a
  /// neighbour of the last good state: `resume()` goes on in whatever rest is near.
  TwistPathEnd advance(double t, const Watch& watch);

  /// From the last good state the held ends a little further on towards t, down the energy to rest.
  bool resume(double t, const Watch& watch);

  void allow_unstable(bool allow) { unstable_ = allow; }
  double t() const { return t_; }
  const TwistState& state() const { return state_; }
  const NewtonReport& report() const { return report_; }
  TwistSolver& solver() { return solver_; }
  /// Largest axial strain of an edge.
  double largest_strain() const;

 private:
  bool step(double t);
  TwistState predicted(double t) const;
  bool rest(double t, TwistState state, const Watch& watch);
  void accept(double t, TwistState state, const NewtonReport& report);

  const TwistModel& model_;
  PinnedMotion motion_;
  PathOptions options_;
  TwistSolver solver_;
  bool unstable_ = false;
  double t_ = 0, before_t_ = 0, step_ = 0.02;
  bool has_before_ = false, finite_ = true;
  TwistState state_;
  NewtonReport report_;
  Eigen::VectorXd velocity_, before_velocity_;
};

}  // namespace gridshell
