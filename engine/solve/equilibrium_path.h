// How what is prescribed moves along a path: pinned nodes, held joints, loads.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/watch.h"
#include "engine/footprint/actuation.h"
#include "engine/footprint/mesh.h"
#include "engine/solve/newton.h"

namespace gridshell {

/// How far a motion has come at path parameter t.
enum class PathLaw {
  square,  ///< t^2: a shell that buckles out of the flat rises as the square root of how far its
           ///< boundary came, so positions are smooth in t = sqrt(progress) down to the flat
  even     ///< t
};

/// The progress of an actuation at its path parameter, and the other way.
inline double progress_at(double t) { return t * t; }
inline double parameter_at(double progress) { return std::sqrt(std::max(progress, 0.0)); }

/// A factor that grows with the motion.
struct LoadFactor {
  double begin = 0, change = 0;
};

/// A node on an arm about another one: the arm turns and changes its length evenly in t.
struct EndRotation {
  int node = 0, about = 0;
  Eigen::Vector3d arm{0, 0, 0};   ///< at t = 0, mm
  Eigen::Vector3d axis{0, 0, 1};  ///< unit
  double angle = 0;               ///< to t = 1, rad
  double stretch = 0;             ///< the arm's length is 1 + t stretch times what it was

  /// The arm at t, and how it changes by t.
  Eigen::Vector3d at(double t) const;
  Eigen::Vector3d rate(double t) const;
};

/// The turn about a node that takes the arm `from` to the arm `to` the shorter way.
EndRotation rotation_between(int node, int about, const Eigen::Vector3d& from,
                             const Eigen::Vector3d& to);

/// Where the pinned nodes, and of held nodes the held components, are at path parameter t, how fast
/// they move, and how much of the dead loads and of a field acts. By default loads come on in
/// proportion: the flat shell carries none.
struct PinnedMotion {
  Eigen::Matrix3Xd begin;   ///< 3 x nodes at t = 0 (what is free is ignored)
  Eigen::Matrix3Xd change;  ///< to t = 1
  PathLaw law = PathLaw::square;
  LoadFactor load{0, 1};
  LoadFactor field{0, 0};
  LoadFactor opening{0, 0};             ///< of the joints that are opened
  std::vector<EndRotation> turns = {};  ///< these nodes do not move straight

  double progress(double t) const { return law == PathLaw::square ? progress_at(t) : t; }
  double speed(double t) const { return law == PathLaw::square ? 2 * t : 1.0; }
  Eigen::Matrix3Xd at(double t) const;
  Eigen::Matrix3Xd rate(double t) const;  ///< by t
  double factor_at(const LoadFactor& growth, double t) const {
    return growth.begin + progress(t) * growth.change;
  }
  /// Sets the loads of `system` to those at t.
  void apply_loads(Linearisation& system, double t) const;
  /// Puts what is prescribed where it belongs at t, and the loads on.
  void impose(Linearisation& system, double t, State& state) const;
  /// How all columns follow at a state just factorised, and the axial forces with them; by t.
  void velocity(Linearisation& system, double t, const State& state, State& velocity) const;
};

/// The motion of a mesh's pinned nodes: its edge points and held joints, the far ends of tails,
/// which turn about them, beyond those whose direction is held their ghosts, and supports of
/// springs.
PinnedMotion pinned_motion(const RodMesh& mesh, const BoundaryMotion& motion);

// Following an equilibrium while the pinned nodes move: predictor and corrector with one
// factorisation a step, steps chosen by how well the prediction did.

/// A state on the path with its derivative by t.
struct PathPoint {
  double t = 0;
  State state;
  State velocity;  ///< by t; it has no frames
};

/// The cubic at t through two states of a path and their tangents [Hermite]; angles, which count
/// from a state's own frames, go on from the first.
State between(const Model& model, const PathPoint& a, const PathPoint& b, double t);

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

  /// Goes on from a point that was followed before, with the step that served there, under the
  /// loads of that point. `across`: a point further on, which stays there meanwhile, to which its
  /// branch goes on; what lies between them is looked for on the cubic through both, at once.
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
  const PathPoint* across_ = nullptr;         // of resume(), until a step is taken
  static constexpr double first_step = 0.05;  // in t
  double step_ = first_step;
};

// Following a path by its arc length: also where it turns back in its parameter (a limit point) and
// through states that are not stable [Riks 1979, Crisfield 1981].

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
