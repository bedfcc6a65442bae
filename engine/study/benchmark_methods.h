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

/// What a method reports. Claims: right (success), refused, not_converged, blow_up, too_slow.
struct MethodResult {
  record::RunOutcome claim = record::RunOutcome::refused;
  Eigen::Matrix3Xd x = {};  ///< joints in the first columns; of spring joints the middles
  /// on the problem's mesh where the claim can be checked there: negative pivots, residual
  bool whole_mesh = false;
  int edges = 0, dof = 0;
  int negative_pivots = 0;  ///< of the last factorisation, where the method has one
  double seconds = 0;       ///< of the processor that it is charged for: certified starts are given

  /// On the mesh of a problem, before the method begins.
  static MethodResult on(const Problem& problem) {
    return {.whole_mesh = true, .edges = problem.edges, .dof = problem.model.dof()};
  }
};

/// One method on one mesh.
struct Method {
  std::string name;
  std::function<MethodResult(BenchmarkProblem&, const Watch&)> run;
};

/// Chebyshev's net at the joints, without mechanics; refused where there is no net.
Method net_method();

/// How the engine's path follower is used.
struct FollowOptions {
  LevelPlan plan;
  double tolerance = 1e-3;  ///< of the joints, over the length scale
  bool refine = false;      ///< finer meshes until the estimate meets it, all on the bill
  int stops = 1;            ///< certified states that an actuation comes through
  ModelVariant on = {};
};
MethodResult follow_path(BenchmarkProblem& study, FollowOptions options, const Watch& watch);
/// On the meshes of a plan, and as precisely as they are worth.
Method plan_method(std::string name, const LevelPlan& plan, const ModelVariant& on = {});
/// As an experiment with `accuracy.tolerance`.
Method auto_method(double tolerance);

/// What keeps Newton's method on a minimum: nothing (full steps); a full direction, shortened until
/// the residual falls; a Hessian shifted until it is positive definite, and a line search.
enum class Globalisation { none, line_search, shifted };
constexpr auto words(Globalisation) {
  return names_except<Globalisation>({{Globalisation::none, "full steps"},
                                      {Globalisation::line_search, "line search"},
                                      {Globalisation::shifted, "shifted"}});
}

/// Newton's method on the Hessian of the energy, factorised by supernodal CHOLMOD in its own order:
/// the boundary is moved, and the equilibrium is computed from there without prediction.
struct MarchOptions {
  int load_steps = 40;
  Globalisation globalisation = Globalisation::shifted;
  double tolerance_mm = 1e-5;
};
MethodResult march(const Problem& problem, const MarchOptions& options, const Watch& watch);
Method textbook_method(int edges);

/// Methods that move in time, to equilibrium after every load step.
enum class Relaxation { kinetic, explicit_damped, implicit_euler };
constexpr auto words(Relaxation) {
  return names_except<Relaxation>({{Relaxation::kinetic, "dynamic relaxation"},
                                   {Relaxation::explicit_damped, "explicit"},
                                   {Relaxation::implicit_euler, "implicit Euler"}});
}
struct RelaxationOptions {
  Relaxation kind = Relaxation::kinetic;
  int load_steps = 40;
  double step = 0.9;          ///< of the limit; implicit: seconds
  double tolerance_N = 1e-5;  ///< largest force left at the end
};
MethodResult relax(const Problem& problem, const RelaxationOptions& options, const Watch& watch);
Method relaxed_method(Relaxation kind, int edges);

/// Off the equilibrium by 0.01 mm, then a fixed number of explicit steps.
MethodResult hold(const Problem& problem, double over_l_c, const Watch& watch);

/// The path from the flat with a dome on it to the study's start, as a problem of its own.
Problem from_flat(const BenchmarkProblem& study, const Problem& problem, double height);

/// The first buckled state, as the engine finds it.
MethodResult buckle(const BenchmarkProblem& study, const Problem& problem, const Watch& watch);

// Judging a run by a reference.

/// Accuracy to which a method on one mesh claims to have converged, over the length scale.
inline constexpr double claimed_error = 1e-4;

/// Judges a result by the equilibrium of the *same* mesh on the reference's branch, so that the
/// error of the mesh does not count: joints further than ten times `claimed` (over the length
/// scale) from it are wrong. Results that cannot be checked on one mesh (extrapolated, spring
/// joints) are judged by the reference itself, with `allowed` as the error that the method
/// promises. A result that is wrong but claimed right is a planar saddle (all joints within 1e-3 of
/// the boundary's plane), another state (a stable equilibrium of the mesh) or silently wrong
/// (neither, or negative pivots). A method's report that it failed is accepted.
record::RunOutcome verdict_of(BenchmarkProblem& study, const MethodResult& result, double claimed,
                              double allowed, const Watch& watch);

/// Judges positions on the mesh of a problem by the problem's own end.
record::RunOutcome verdict_at_end(const BenchmarkProblem& study, const Problem& problem,
                                  const Eigen::Matrix3Xd& x, double claimed);

// Baselines that charts compare with, never a default: the explicit integrator and kinetic dynamic
// relaxation, with the bend model.

struct BaselineReport {
  Outcome end = Outcome::not_converged;  ///< reached, not_converged, not_finite (grown), cancelled
  int steps = 0;
  double residual_N = 0;
};

struct BaselineOptions {
  /// fraction of the largest stable step: for dynamic relaxation Gershgorin's bound for unstressed
  /// rods (under tension they are stiffer), for the explicit integrator l_min/c; implicit: seconds
  double step = 0.9;
  double damping_per_s = 0;   ///< explicit integrator only
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
/// damping; at each peak of the kinetic energy positions go back to it, velocities to zero, and the
/// next kick is half a one.
BaselineReport dynamic_relaxation(const Model& model, State& state, const BaselineOptions& options,
                                  const Watch& watch);

/// Implicit Euler, m (v1 - v0)/h = F(x1) - c m v1, x1 = x0 + h v1, one complete Newton solve per
/// step, until equilibrium: large steps are dissipative. `options.step` is h in seconds. A step
/// that Newton's method does not solve ends it as `not_converged` with the steps so far.
BaselineReport implicit_to_rest(const Model& model, const Eigen::Matrix3Xd& mass,
                                MovingState& moving, const BaselineOptions& options,
                                const Watch& watch);

}  // namespace gridshell::study
