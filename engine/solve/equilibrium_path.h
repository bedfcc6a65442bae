// PathFollower: follows an equilibrium of one mesh while its pinned nodes move, by a predictor and
// a corrector with one factorisation per step.
#pragma once

#include <span>
#include <vector>

#include "engine/core/watch.h"
#include "engine/solve/newton.h"
#include "engine/solve/pinned_motion.h"

namespace gridshell {

/// A state on the path with its derivative by the path parameter t. PathFollower computes it.
struct PathPoint {
  static constexpr double first_step = 0.05;  // in t
  /// Path parameter, dimensionless.
  double t = 0;
  /// Positions and twist angles (mm, see Model), axial forces (N).
  State state;
  State velocity = {};       ///< derivative of `state` by t; it has no frames
  double step = first_step;  ///< next step in t, from the error of the last prediction
};

/// Hermite polynomial at t through states of a path and their tangents. Twist angles count from the
/// frames of the first state.
State between(const Model& model, std::span<const PathPoint* const> points, double t);

struct PathOptions {
  double spacing_mm = 20;       ///< d, the scale of corrections
  double target_move = 0.01;    ///< intended correction, in d: sets the next step
  double largest_move = 0.1;    ///< largest accepted correction, in d; above it the step is halved
  double largest_step = 0.25;   ///< in t
  double smallest_step = 1e-5;  ///< in t; below it the path counts as lost
  /// Newton's method ends at requested points when no node moves further, mm; at points between
  /// them when none moves further than `target_move`.
  double tolerance_mm = 1e-6;
  /// cosine of the angle between two edges below which they count as folded
  double widest_turn = -0.5;
  bool allow_unstable = false;  ///< continue through states with negative pivots
  Team* team = nullptr;         ///< threads for large matrices; null: one thread
};

struct PathReport {
  Outcome end = Outcome::reached;  ///< reached, unstable, folded, lost, not_finite or cancelled
  double t = 0;                    ///< path parameter up to which the path is certified
  NewtonReport last;               ///< Newton's report of the last converged point
};

/// Follows one model along one motion of its pinned nodes, forwards or backwards. It stores the
/// current point and the one before it. Between two accepted points the correction is a small part
/// of the predicted displacement, no pivot is negative and no edge folds; the points are then on
/// one stable branch.
class PathFollower {
 public:
  PathFollower(Linearisation& system, const PinnedMotion& motion, const PathOptions& options);

  /// Corrects a state at t to the tolerance and computes its tangent.
  PathReport start(double t, State state, const Watch& watch = unwatched);

  /// Follows the path to t and converges there. On failure the current point is the last converged
  /// one.
  PathReport advance(double t, const Watch& watch);

  /// Continues from an earlier point under the loads of that point, without a factorisation.
  /// `across`: a later point of the same branch, which must remain valid; states between the two
  /// are predicted in one step on the cubic through both.
  void resume(const PathPoint& point, const PathPoint* across = nullptr);

  /// State predicted at t from the tangents of the current point and the one before it.
  State predict(double t) const;

  void allow_unstable(bool allow) { options_.allow_unstable = allow; }
  const PathPoint& point() const { return now_; }
  const NewtonReport& last() const { return last_; }  ///< report of the current point
  const PinnedMotion& motion() const { return motion_; }

 private:
  Outcome step(double t, bool converge, NewtonReport& report, const Watch& watch);
  void take_velocity(PathPoint& point);

  Linearisation& system_;
  PinnedMotion motion_;
  PathOptions options_;
  PathPoint now_, before_;
  NewtonReport last_;
  bool has_before_ = false;
  const PathPoint* across_ = nullptr;  // argument of resume(), until the first step
};

}  // namespace gridshell
