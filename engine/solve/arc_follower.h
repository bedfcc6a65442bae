// ArcFollower: follows a path by its arc length, also past limit points of its parameter and
// through unstable states [Riks 1979, Crisfield 1981].
#pragma once

#include <optional>

#include "engine/solve/equilibrium_path.h"

namespace gridshell {

struct ArcOptions {
  double step_mm = 1;          ///< the first step; later ones follow how hard the last was
  double largest_mm = 5;       ///< of a step
  double smallest_mm = 1e-4;   ///< below, the path is lost
  double parameter_mm = 1;     ///< what a parameter of one counts as in the arc length
  double tolerance_mm = 1e-7;  ///< of Newton's corrections
};

/// A point of the path with the inertia of its Hessian at fixed parameter. A change of the number
/// of negative pivots from one point to the next shows a limit point or a bifurcation between them.
struct ArcPoint {
  PathPoint point;
  Inertia inertia;
};

/// Arc length s: ds^2 = |dx|^2 / nodes + (parameter_mm dt)^2. A step predicts along the unit
/// tangent and corrects positions and parameter perpendicular to it, by block elimination on the
/// Hessian at fixed parameter.
class ArcFollower {
 public:
  ArcFollower(Linearisation& system, const PinnedMotion& motion, const ArcOptions& options);

  /// Starts at an equilibrium at t; the path continues with t increasing (direction 1) or
  /// decreasing (-1). Outcomes as newton().
  Outcome start(double t, State state, double direction = 1, const Watch& watch = unwatched);

  /// One step, halved until it succeeds; lost where that ends in steps that are too small: the
  /// point is then the last good one.
  Outcome step(const Watch& watch = unwatched);

  /// Switches at a bifurcation to the branch nearest to the state displaced by `mm` along a lowest
  /// mode (no parameter): predicts along the mode and corrects perpendicular to it. The path
  /// continues away from `from`. Outcomes: reached, lost, cancelled.
  Outcome leave(const PathPoint& from, const Eigen::Matrix3Xd& mode, double mm,
                const Watch& watch = unwatched);

  /// The next step is so long; later ones as ever.
  void set_step(double mm) { step_mm_ = mm; }
  double step_mm() const { return step_mm_; }
  /// dt/ds; its sign changes at a limit point.
  double turn() const { return turn_t_; }

  const ArcPoint& at() const { return now_; }

 private:
  bool corrected(ArcPoint& next, int& iterations, const Watch& watch);
  double product(const State& a, double at, const State& b, double bt) const;
  void take_tangent(ArcPoint& at, const State* before, double before_t);

  Linearisation* system_;
  PinnedMotion motion_;
  ArcOptions options_;
  double step_mm_;
  ArcPoint now_;
  double turn_t_ = 1;  // dt/ds; now_.point.velocity is dx/ds
};

/// Parameter of the limit point after the equilibrium `begin`: the extreme value in `direction`,
/// within a limited number of steps. Empty if the path has none there (stability is lost at a
/// bifurcation), cannot be followed, or was cancelled.
std::optional<double> turning_point(Linearisation& system, const PinnedMotion& motion,
                                    const PathPoint& begin, double direction,
                                    const ArcOptions& options, const Watch& watch);

}  // namespace gridshell
