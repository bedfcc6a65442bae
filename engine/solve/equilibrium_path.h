// Following an equilibrium while the pinned nodes move: predictor and corrector with one
// factorisation a step, steps chosen by how well the prediction did.
#pragma once

#include <span>
#include <vector>

#include "engine/core/watch.h"
#include "engine/solve/newton.h"
#include "engine/solve/pinned_motion.h"

namespace gridshell {

/// A state on the path with its derivative by t.
struct PathPoint {
  static constexpr double first_step = 0.05;  // in t
  double t = 0;
  State state;
  State velocity = {};       ///< by t; it has no frames
  double step = first_step;  ///< in t: the next one, by how well the last prediction did
};

/// The polynomial at t through states of a path and their tangents [Hermite]; angles, which count
/// from a state's own frames, go on from the first.
State between(const Model& model, std::span<const PathPoint* const> points, double t);

struct PathOptions {
  double spacing_mm = 20;       ///< d: what moves are measured against
  double target_move = 0.01;    ///< correction aimed at, of d: sets the next step
  double largest_move = 0.1;    ///< correction refused, of d: the step is halved
  double largest_step = 0.25;   ///< in t
  double smallest_step = 1e-5;  ///< in t: below, the path is lost
  double tolerance_mm =
      1e-6;  ///< of points that are asked for; between them one correction is enough
  double widest_turn = -0.5;    ///< cosine of the turn at which two edges have folded
  bool allow_unstable = false;  ///< go on through states with negative pivots
  Team* team = nullptr;         ///< who helps with large matrices
};

struct PathReport {
  Outcome end = Outcome::reached;  ///< reached, unstable, folded, lost, not_finite, cancelled
  double t = 0;                    ///< how far the path is certified
  int steps = 0, halvings = 0;
  NewtonReport last;  ///< of the last point that was converged
};

/// Follows one model along one motion of its pinned nodes, forwards or backwards. Holds the current
/// point and the one before it. Between two accepted points the correction is a small part of the
/// move predicted, no pivot is negative and no edge folds, so they lie on one stable branch.
class PathFollower {
 public:
  PathFollower(Linearisation& system, const PinnedMotion& motion, const PathOptions& options);

  /// Takes an equilibrium at t and works out its tangent. The state is first corrected to
  /// tolerance.
  PathReport start(double t, State state, const Watch& watch = unwatched);

  /// Follows the path to t and converges there. On failure the current point is the last good one.
  PathReport advance(double t, const Watch& watch);

  /// Continues from a point that was followed before, under the loads of that point, without a
  /// factorisation. `across`: a point further on, which stays valid meanwhile, on the same branch:
  /// states between them are predicted on the cubic through both, in one step.
  void resume(const PathPoint& point, const PathPoint* across = nullptr);

  /// Predicted state at t from the current point (by its tangent and that of the point before).
  State predict(double t) const;

  void allow_unstable(bool allow) { options_.allow_unstable = allow; }
  const PathPoint& point() const { return now_; }
  const NewtonReport& last() const { return last_; }  ///< of the current point
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
  const PathPoint* across_ = nullptr;  // of resume(), until a step is taken
};

}  // namespace gridshell
