// ArcFollower: follows a path by its arc length, also past limit points of its parameter and
// through unstable states [Riks 1979, Crisfield 1981].
#pragma once

#include <optional>

#include "engine/solve/equilibrium_path.h"

namespace gridshell {

struct ArcOptions {
  double step_mm = 1;          ///< first step; the next depends on the corrections of the last
  double largest_mm = 5;       ///< largest step
  double smallest_mm = 1e-4;   ///< smallest step; below it the path counts as lost
  double parameter_mm = 1;     ///< arc length of a change of the parameter by one
  double tolerance_mm = 1e-7;  ///< Newton's method ends when no node moves further
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

  /// Takes one step, halved until it succeeds. Outcomes: reached, cancelled, or lost if the step
  /// would be below `smallest_mm`; then the current point is unchanged.
  Outcome step(const Watch& watch = unwatched);

  /// Switches to another branch at the bifurcation `from`: predicts a state at the arc length `mm`
  /// along `mode`, a lowest mode, without a change of the parameter, and corrects it perpendicular
  /// to the mode. The path continues away from `from`. Outcomes: reached, lost, not_finite,
  /// cancelled.
  Outcome leave(const PathPoint& from, const Eigen::Matrix3Xd& mode, double mm,
                const Watch& watch = unwatched);

  /// Sets the length of the next step; later steps are chosen as usual.
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

/// Parameter of the limit point after the equilibrium `begin`: the last value before the parameter
/// changes against `direction`, among at most 40 steps. Empty if there is none (stability is lost
/// at a bifurcation), or if the path cannot be followed or was cancelled.
std::optional<double> turning_point(Linearisation& system, const PinnedMotion& motion,
                                    const PathPoint& begin, double direction,
                                    const ArcOptions& options, const Watch& watch);

}  // namespace gridshell
