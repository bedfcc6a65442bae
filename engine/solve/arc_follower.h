// Following a path by its arc length: also where it turns back in its parameter (a limit point) and
// through states that are not stable [Riks 1979, Crisfield 1981].
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

/// A point of the path, and the inertia of the Hessian there with the parameter held: one negative
/// pivot more or less than at the point before says that a limit or a bifurcation lies between.
struct ArcPoint {
  PathPoint point;
  Inertia inertia;
};

/// Arc length s: ds^2 = |dx|^2 / nodes + (parameter_mm dt)^2. A step predicts along the unit
/// tangent and corrects at right angles to it, positions and parameter together, by block
/// elimination on the Hessian at held parameter.
class ArcFollower {
 public:
  ArcFollower(Linearisation& system, const PinnedMotion& motion, const ArcOptions& options);

  /// Takes an equilibrium at t; the path goes on with t growing (direction 1) or falling (-1).
  /// Outcomes as newton().
  Outcome start(double t, State state, double direction = 1, const Watch& watch = unwatched);

  /// One step, halved until it succeeds; lost where that ends in steps that are too small: the
  /// point is then the last good one.
  Outcome step(const Watch& watch = unwatched);

  /// Leaves a path at a bifurcation, on to the branch that comes closest to `mm` along a soft mode
  /// (no parameter): predicted along it and corrected at right angles to it. The path goes on away
  /// from there. Outcomes: reached, lost, cancelled.
  Outcome leave(const PathPoint& from, const Eigen::Matrix3Xd& mode, double mm,
                const Watch& watch = unwatched);

  /// The next step is so long; later ones as ever.
  void set_step(double mm) { step_mm_ = mm; }
  double step_mm() const { return step_mm_; }
  /// Change of the parameter with the arc length: it changes its sign where the path turns back.
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

/// Where the path from the equilibrium `begin` turns back: its farthest parameter in `direction`,
/// looked for over some steps. Empty when it goes on (what was lost is stability, at a
/// bifurcation), cannot be followed, or is no longer wanted.
std::optional<double> turning_point(Linearisation& system, const PinnedMotion& motion,
                                    const PathPoint& begin, double direction,
                                    const ArcOptions& options, const Watch& watch);

}  // namespace gridshell
