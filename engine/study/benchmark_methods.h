// Methods for solving a benchmark problem from its start to its end: the engine's own, and those of
// other programs and textbooks.
#pragma once

#include <functional>
#include <string>

#include "engine/core/enum_words.h"
#include "engine/core/outcome.h"
#include "engine/core/watch.h"
#include "engine/record/study_tables.h"
#include "engine/solve/dynamics.h"
#include "engine/study/benchmark_problem.h"

namespace gridshell::study {

/// What a method reports.
struct MethodResult {
  /// right (success), refused, not_converged, blow_up or too_slow
  record::RunOutcome claim = record::RunOutcome::refused;
  Eigen::Matrix3Xd x = {};  ///< positions, mm: the joints first; middles of spring joints
  /// whether `x` has all nodes of one mesh, so that the claim can be checked on it (negative
  /// pivots, residual)
  bool whole_mesh = false;
  int edges = 0, dof = 0;   ///< edges per segment and unknowns of the finest mesh
  int negative_pivots = 0;  ///< of the last factorisation, if the method has one
  double seconds = 0;       ///< processor time of the method, without that of the given start

  /// The result of a method on the mesh of a problem before it begins.
  static MethodResult on(const Problem& problem) {
    return {.whole_mesh = true, .edges = problem.edges, .dof = problem.model.dof()};
  }
};

/// A method with its parameters, for example on one mesh.
struct Method {
  std::string name;
  std::function<MethodResult(BenchmarkProblem&, const Watch&)> run;
};

/// The Chebyshev net at the joints, without mechanics; refused for scenes without a net.
Method net_method();

/// How the engine's path follower is used.
struct FollowOptions {
  LevelPlan plan;
  double tolerance = 1e-3;  ///< of the joints, over the length scale
  bool refine = false;      ///< finer meshes until the error estimate meets it; all are timed
  int stops = 1;            ///< number of certified states on the path of an actuation
  ModelVariant on = {};
};
MethodResult follow_path(BenchmarkProblem& study, FollowOptions options, const Watch& watch);
/// follow_path() on the meshes of a plan, with the error expected of them as the tolerance.
Method plan_method(std::string name, const LevelPlan& plan, const ModelVariant& on = {});
/// follow_path() that refines its meshes, as an experiment with this `accuracy.tolerance` does.
Method auto_method(double tolerance);

/// How Newton's method is made to converge to a minimum: not at all (full steps); by a line search
/// that shortens the step until the residual falls; or by a Hessian shifted until it is positive
/// definite, with a line search on the energy.
enum class Globalisation { none, line_search, shifted };
constexpr auto words(Globalisation) {
  return names_except<Globalisation>({{Globalisation::none, "full steps"},
                                      {Globalisation::line_search, "line search"},
                                      {Globalisation::shifted, "shifted"}});
}

struct MarchOptions {
  int load_steps = 40;
  Globalisation globalisation = Globalisation::shifted;
  double tolerance_mm = 1e-5;  ///< of Newton's corrections
};
/// Newton's method as in textbooks, on the Hessian of the energy, factorised by supernodal CHOLMOD
/// in the ordering that CHOLMOD chooses. In each load step the boundary is moved, and the
/// equilibrium is computed from the last one without prediction.
MethodResult march(const Problem& problem, const MarchOptions& options, const Watch& watch);
/// march() with its default options.
Method textbook_method(int edges);

/// Methods that compute a motion in time until it ends in equilibrium.
enum class Relaxation { kinetic, explicit_damped, implicit_euler };
constexpr auto words(Relaxation) {
  return names_except<Relaxation>({{Relaxation::kinetic, "dynamic relaxation"},
                                   {Relaxation::explicit_damped, "explicit"},
                                   {Relaxation::implicit_euler, "implicit Euler"}});
}
struct RelaxationOptions {
  Relaxation kind = Relaxation::kinetic;
  int load_steps = 40;
  double step = 0.9;          ///< time step as a fraction of its limit; implicit: in seconds
  double tolerance_N = 1e-5;  ///< largest residual force at the end
};
/// Kinetic and implicit methods converge after every load step; the explicit one moves the boundary
/// slowly instead, during four periods of the lowest mode, which it damps critically.
MethodResult relax(const Problem& problem, const RelaxationOptions& options, const Watch& watch);
Method relaxed_method(Relaxation kind, int edges);

/// Explicit steps from the problem's end, perturbed by 0.01 mm: right if 20 000 damped steps do not
/// diverge. `over_l_c` is the time step over l_min/c.
MethodResult check_explicit_step(const Problem& problem, double over_l_c, const Watch& watch);

/// A problem from the flat footprint to the start of `problem`; its initial guess is a dome of
/// `height` mm.
Problem from_flat(const BenchmarkProblem& study, const Problem& problem, double height);

/// The first buckled state (first_buckled()), at the start of `problem`.
MethodResult buckle(const BenchmarkProblem& study, const Problem& problem, const Watch& watch);

// Judging a run by a reference.

/// Accuracy to which a method on one mesh claims to have converged, over the length scale.
inline constexpr double claimed_error = 1e-4;

/// Judges a result by the equilibrium of the *same* mesh on the reference's branch, so that the
/// error of the mesh does not count: joints further than ten times `claimed` (over the length
/// scale) from it are wrong. Results that cannot be checked on one mesh (extrapolated, spring
/// joints) are judged by the reference itself, with `allowed` as the error that the method
/// promises. A result that is wrong but claimed right is a planar saddle (all joints within 1e-3
/// length scales of one height), another state (a stable equilibrium of the mesh) or silently wrong
/// (neither, or negative pivots). A method's report that it failed is accepted.
record::RunOutcome verdict_of(BenchmarkProblem& study, const MethodResult& result, double claimed,
                              double allowed, const Watch& watch);

/// Judges positions on the mesh of a problem by the problem's own end.
record::RunOutcome verdict_at_end(const BenchmarkProblem& study, const Problem& problem,
                                  const Eigen::Matrix3Xd& x, double claimed);

// Baselines that charts compare with the default solver: the explicit integrator, kinetic dynamic
// relaxation and implicit Euler, with the bend model.

struct BaselineReport {
  /// reached, not_converged, not_finite (strains or energies diverged) or cancelled
  Outcome end = Outcome::not_converged;
  int steps = 0;
  double residual_N = 0;
};

struct BaselineOptions {
  /// fraction of the largest stable step: for dynamic relaxation Gershgorin's bound for unstressed
  /// rods (under tension they are stiffer), for the explicit integrator l_min/c; implicit: seconds
  double step = 0.9;
  double damping_per_s = 0;   ///< mass-proportional; not used by dynamic relaxation
  double tolerance_N = 1e-7;  ///< equilibrium: no larger force on a free node
  int most_steps = 2000000;
};

/// The largest stable step of the explicit integrator, s: l_min/c, c = sqrt(EA/(mass per length)),
/// over the edges [Courant, Friedrichs, Lewy 1928].
double courant_step(const Model& model, const Eigen::Matrix3Xd& mass);

/// Symplectic Euler with mass-proportional damping, v += h F/m, x += h v, until equilibrium.
BaselineReport explicit_to_rest(const Model& model, const Eigen::Matrix3Xd& mass,
                                MovingState& moving, const BaselineOptions& options,
                                const Watch& watch);

/// Kinetic dynamic relaxation [Barnes 1999]: fictitious masses from each node's stiffness, no
/// damping. After each peak of the kinetic energy the positions are set back to those of the peak,
/// the velocities to zero, and the next change of velocity is half of a normal one.
BaselineReport dynamic_relaxation(const Model& model, State& state, const BaselineOptions& options,
                                  const Watch& watch);

/// Implicit Euler, m (v1 - v0)/h = F(x1) - c m v1, x1 = x0 + h v1, one complete Newton solve per
/// step, until equilibrium: large steps are dissipative. `options.step` is h in seconds, c the
/// damping. A step that Newton's method does not solve ends the run as `not_converged`.
BaselineReport implicit_to_rest(const Model& model, const Eigen::Matrix3Xd& mass,
                                MovingState& moving, const BaselineOptions& options,
                                const Watch& watch);

}  // namespace gridshell::study
