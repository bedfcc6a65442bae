// Following an equilibrium while the pinned nodes move: predictor and corrector with one
// factorisation a step, steps chosen by how well the prediction did.
#pragma once

#include <functional>
#include <string>

#include "engine/solve/newton.h"

namespace gridshell {

/// How far a motion has come at path parameter t.
enum class Pace {
  square,  ///< t^2: a shell that buckles out of the flat rises as the square root of how far its
           ///< boundary came, so positions are smooth in t = sqrt(progress) down to the flat
  even     ///< t
};

/// Where the pinned nodes, and of a prescribed node the prescribed components, are at path
/// parameter t, and how fast they move; and how much of the dead loads acts, which come on in
/// proportion: the flat shell carries none.
struct PinnedMotion {
  Eigen::Matrix3Xd begin;   ///< 3 x nodes at t = 0 (what is free is ignored)
  Eigen::Matrix3Xd change;  ///< to t = 1
  Pace pace = Pace::square;
  double load_begin = 0, load_change = 1;  ///< factor of the dead loads, as the positions

  double come(double t) const { return pace == Pace::square ? t * t : t; }
  Eigen::Matrix3Xd at(double t) const { return begin + come(t) * change; }
  Eigen::Matrix3Xd velocity(double t) const {
    return (pace == Pace::square ? 2 * t : 1.0) * change;
  }
  double load(double t) const { return load_begin + come(t) * load_change; }
  double load_velocity(double t) const {
    return (pace == Pace::square ? 2 * t : 1.0) * load_change;
  }
  /// Puts the nodes that `system` does not leave free where they belong at t, and the loads on.
  void impose(Linearisation& system, double t, Eigen::Matrix3Xd& x) const;
};

/// A state on the path with its derivative by t.
struct PathPoint {
  double t = 0;
  State state;
  State velocity;
};

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
};

/// Why a path stopped.
enum class PathEnd { reached, unstable, folded, lost, not_finite, cancelled };

struct PathReport {
  PathEnd end = PathEnd::reached;
  double t = 0;  ///< how far the path is certified
  int steps = 0, halvings = 0;
  NewtonReport last;  ///< of the last point that was converged
};

/// Follows one model along one motion of its pinned nodes, forwards or backwards. Holds the current
/// point and the one before it. Between two accepted points the correction is a small part of the
/// move predicted, no pivot is negative and no edge folds, so they lie on one stable branch.
class PathFollower {
 public:
  PathFollower(Linearisation& system, const PinnedMotion& motion, const PathOptions& options)
      : system_(system), motion_(motion), options_(options) {}

  /// Takes an equilibrium at t and works out its tangent. The state is first corrected to
  /// tolerance.
  PathReport start(double t, State state);

  /// Follows the path to t and converges there. On failure the current point is the last good one.
  PathReport advance(double t, const Watch& watch);

  /// Predicted state at t from the current point (Hermite between the last two, else Taylor).
  State predict(double t) const;

  void allow_unstable(bool allow) { options_.allow_unstable = allow; }
  const PathPoint& point() const { return now_; }
  const NewtonReport& last() const { return last_; }  ///< of the current point
  const PinnedMotion& motion() const { return motion_; }

 private:
  enum class StepOutcome { accepted, refused_unstable, refused_folded, refused_move, not_finite };
  StepOutcome step(double t, bool converge, NewtonReport& report);
  void take_velocity(PathPoint& point) const;

  Linearisation& system_;
  PinnedMotion motion_;
  PathOptions options_;
  PathPoint now_, before_;
  NewtonReport last_;
  bool has_before_ = false;
  static constexpr double first_step = 0.05;  // in t
  double step_ = first_step;
};

}  // namespace gridshell
