// The ways of getting from the start of a problem to its end that studies compare: the engine's
// own, and those that programs and textbooks use.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/record/study_tables.h"
#include "engine/study/benchmark_problem.h"
#include "engine/study/stopwatch.h"

namespace gridshell::study {

/// What a method says it came to. Claims: right (success), refused, not_converged, blow_up,
/// too_slow.
struct MethodResult {
  record::RunOutcome claim = record::RunOutcome::not_converged;
  Eigen::Matrix3Xd x;  ///< joints in the first columns; of spring joints the middles
  /// on the problem's mesh where the claim can be checked there: negative pivots, residual
  bool whole_mesh = false;
  int edges = 0, dof = 0;
  int negative_pivots = 0;  ///< of the last factorisation, where the method has one
};

/// One method on one mesh. `run` starts the stopwatch for what the method is charged for, its
/// set-up too; certified starts are given.
struct Method {
  std::string name;
  int edges = 0;  ///< of the finest mesh; 0: none
  std::function<MethodResult(BenchmarkProblem&, Stopwatch&, const Watch&)> run;
};

/// Path parameter of load step `k` of `steps`: boundary or joint move evenly.
double load_parameter(const Problem& problem, int k, int steps);

/// Chebyshev's net at the joints, without mechanics; refused where there is no net.
Method net_method();

/// The engine's path follower on one mesh.
Method bend_method(int edges);

/// The same on nested meshes, extrapolated where there are three.
Method nested_method(const std::vector<int>& edges);

/// As an experiment with `accuracy.tolerance`: meshes by plan_levels(), finer ones until the
/// estimate meets the tolerance, all on the bill.
Method auto_method(double tolerance);

/// What keeps Newton's method on a minimum.
enum class Globalisation {
  none,         ///< full steps
  line_search,  ///< full direction, shortened until the energy falls (or the residual, on a saddle)
  shifted       ///< Hessian shifted until positive definite, line search
};
const char* name_of(Globalisation globalisation);

/// Newton's method on the energy's own Hessian, factorised by supernodal CHOLMOD in its own order:
/// the boundary is moved, the rest is found from there, no prediction.
struct MarchOptions {
  int load_steps = 40;
  Globalisation globalisation = Globalisation::shifted;
  double tolerance_mm = 1e-5;
  double EA_scale = 1;
  int most_iterations = 400;  ///< a load step
};
MethodResult march(const Problem& problem, const MarchOptions& options, Stopwatch& stopwatch,
                   const Watch& watch);
Method textbook_method(int edges);

/// The path follower on the twist rung, joints shared or held together by springs.
Method twist_method(int edges);
Method spring_method(int edges, double stiffness_N_per_mm);

/// Methods that move in time, to rest after every load step.
enum class Relaxation { kinetic, explicit_damped, implicit_euler };
struct RelaxationOptions {
  Relaxation kind = Relaxation::kinetic;
  int load_steps = 40;
  double step = 0.9;          ///< of the limit; implicit: seconds
  double tolerance_N = 1e-5;  ///< largest force left at the end
  double loose_N = 1e-3;      ///< and in between
};
MethodResult relax(const Problem& problem, const RelaxationOptions& options, Stopwatch& stopwatch,
                   const Watch& watch);
Method relaxed_method(Relaxation kind, int edges);

// What a run came to, seen from outside.

/// What a method on one mesh claims to have come to rest to, of the length scale.
inline constexpr double claimed_error = 1e-4;

/// Judges an arrival by the equilibrium of the *same* mesh on the reference's branch, so that the
/// error of the mesh is nobody's fault: joints further than ten times `claimed` (over the length
/// scale) from there are wrong. What cannot be checked on one mesh (extrapolated, spring joints) is
/// judged by the reference itself, `allowed` being the error that the method promises. Wrong and
/// claimed right is a planar saddle (all joints within 1e-3 of the boundary's plane), another state
/// (a stable equilibrium of the mesh) or silently wrong (neither, or negative pivots). A method's
/// report that it failed is believed.
record::RunOutcome verdict_of(BenchmarkProblem& study, const MethodResult& arrival, double claimed,
                              double allowed, const Watch& watch);

/// The same for positions on the mesh of a problem, by the problem's own end.
record::RunOutcome verdict_at_end(const BenchmarkProblem& study, const Problem& problem,
                                  const Eigen::Matrix3Xd& x, double claimed);

// The runs that only the maps make: what is tried in a cell, beside the methods of method.h.

/// As an experiment runs it, through `stops` certified states: on the meshes of `plan`, and where
/// `tolerance` is above 0 on finer ones until the estimate meets it.
MethodResult default_run(BenchmarkProblem& study, LevelPlan plan, double tolerance, int stops,
                         const Watch& watch);

/// Off the equilibrium by 0.01 mm, then a fixed number of explicit steps.
MethodResult hold(const Problem& problem, double over_l_c, const Watch& watch);

/// The path from the flat with a dome on it to the study's start, as a problem of its own.
Problem from_flat(const BenchmarkProblem& study, const Problem& problem, double height);

/// The first buckled state, as the engine finds it.
MethodResult buckle(const BenchmarkProblem& study, const Problem& problem, const Watch& watch);

}  // namespace gridshell::study
