#include "engine/study/benchmark_methods.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/core/system_info.h"
#include "engine/elastic/model.h"
#include "engine/scene/net_design.h"
#include "engine/solve/buckling.h"
#include "engine/study/cholmod_solver.h"

namespace gridshell::study {
namespace {

using record::RunOutcome;

/// A method that solves the problem on one mesh; refused if the mesh has none.
template <class Run>
Method mesh_method(std::string_view name, int edges, Run run) {
  return {std::string(name), [edges, run](BenchmarkProblem& study, const Watch& watch) {
            const auto problem = study.problem(edges, watch);
            return problem ? run(**problem, watch) : MethodResult{};
          }};
}

constexpr double flat = 1e-3;  // largest height of a planar state, over the length scale

/// Height of the highest joint above the lowest, over the length scale.
double height_of(const BenchmarkProblem& study, const Eigen::Matrix3Xd& x) {
  const auto z = x.leftCols(study.joints()).row(2);
  return (z.maxCoeff() - z.minCoeff()) / study.scale_mm();
}

/// Classifies a result that is not the reference's equilibrium.
RunOutcome kind_of(const BenchmarkProblem& study, const Problem& problem, const Eigen::Matrix3Xd& x,
                   double near_mm) {
  if (height_of(study, x) < flat && height_of(study, problem.end.x) > 10 * flat)
    return RunOutcome::planar_saddle;
  // an equilibrium with its pinned nodes elsewhere does not count
  for (int node = 0; node < problem.model.nodes; ++node)
    if (problem.model.pinned(node) && (x.col(node) - problem.end.x.col(node)).norm() > near_mm)
      return RunOutcome::silent_wrong;
  Linearisation system(problem.model);
  const State state = start_state(problem.model, x);
  if (!system.at(state, false).positive_definite()) return RunOutcome::silent_wrong;
  Eigen::Matrix3Xd dx;
  system.correction(dx);
  return max_column_norm(dx) < near_mm ? RunOutcome::other_state : RunOutcome::silent_wrong;
}

constexpr int most_iterations = 400;  // per load step

/// Newton's method with full or shortened steps on the energy's Hessian, whatever its inertia.
RunOutcome rest_unshifted(Linearisation& system, State& state, const MarchOptions& options,
                          const Watch& watch) {
  Eigen::Matrix3Xd dx;
  State trial;
  Assembly there;
  for (int k = 0; k < most_iterations; ++k) {
    if (watch.cancelled()) return RunOutcome::too_slow;
    if (!system.at(state, false).usable) return RunOutcome::blow_up;
    system.correction(dx);
    const double move = max_column_norm(dx);
    if (!std::isfinite(move) || !std::isfinite(system.assembly().energies.total()))
      return RunOutcome::blow_up;
    double factor = 1;
    if (options.globalisation == Globalisation::line_search) {
      // Newton's direction reduces the residual even if the Hessian is indefinite
      const auto unbalanced = [&](Eigen::Matrix3Xd gradient) {
        clear_fixed(system.model(), gradient);
        return gradient.norm();
      };
      const double before = unbalanced(system.assembly().gradient);
      for (; factor > 1e-6; factor /= 2) {
        trial = state;
        move_to(system.model(), state.x + factor * dx, trial);
        assemble_gradient(system.model(), trial, system.outside, there);
        const double after = unbalanced(there.gradient);
        if (after <= (1 - 1e-4 * factor) * before) break;
      }
    }
    move_to(system.model(), state.x + factor * dx, state);
    if (move <= options.tolerance_mm) return RunOutcome::right;
    if (move > 1e6) return RunOutcome::blow_up;
  }
  return RunOutcome::not_converged;
}

/// Newton's method with the Hessian shifted until it is positive definite and the step shortened
/// until the energy falls.
RunOutcome rest_shifted(Linearisation& system, State& state, const MarchOptions& options,
                        const Watch& watch) {
  const auto energy_at = [&](const State& at) {
    return energies_of(system.model(), at, system.outside).total();
  };
  Eigen::Matrix3Xd dx;
  State trial;
  double shift = 0;
  for (int k = 0; k < most_iterations; ++k) {
    if (watch.cancelled()) return RunOutcome::too_slow;
    Inertia inertia = system.at(state, false, shift);
    const double first = shift;
    while (!inertia.positive_definite()) {
      if (shift > 1e8) return RunOutcome::blow_up;
      shift = std::max(4 * shift, 1e-6);
      inertia = system.shifted(shift);
    }
    system.correction(dx);
    const double move = max_column_norm(dx);
    if (!std::isfinite(move)) return RunOutcome::blow_up;
    if (move <= options.tolerance_mm && shift == 0) {
      move_to(system.model(), state.x + dx, state);
      return RunOutcome::right;
    }
    const double start = energy_at(state),
                 slope = (system.assembly().gradient.array() * dx.array()).sum();
    double step = 1;
    for (; step > 1e-10; step /= 2) {
      trial = state;
      move_to(system.model(), state.x + step * dx, trial);
      if (energy_at(trial) <= start + 1e-4 * step * slope + 1e-14 * std::abs(start)) break;
    }
    std::swap(state, trial);
    shift = step == 1 && first == shift ? (shift < 1e-5 ? 0 : shift / 4) : shift;
  }
  return RunOutcome::not_converged;
}

}  // namespace

Method net_method() {
  return {"net", [](BenchmarkProblem& study, const Watch&) {
            MethodResult result;
            const auto& scene = study.scene();
            if (!scene.net || study.task() == Task::push) return result;
            const double begin = cpu_seconds_now();
            Eigen::Matrix2Xd uv(2, study.joints());
            for (int k = 0; k < study.joints(); ++k)
              uv.col(k) << scene.footprint.joints[std::size_t(k)].u,
                  scene.footprint.joints[std::size_t(k)].v;
            auto net = points_on(*scene.net, uv);
            result.seconds = cpu_seconds_now() - begin;
            if (!net) return result;
            result.claim = RunOutcome::right;
            result.x = std::move(*net);
            result.dof = 3 * study.joints();
            return result;
          }};
}

MethodResult follow_path(BenchmarkProblem& study, FollowOptions options, const Watch& watch) {
  MethodResult result;
  for (;;) {
    double begin = cpu_seconds_now();
    NestedShell shell = study.shell(options.plan, options.tolerance, options.on);
    result.seconds += cpu_seconds_now() - begin;
    NestedReport report = study.begin(shell, watch);
    if (report.end == Outcome::reached) {
      begin = cpu_seconds_now();
      report = study.go(shell, watch, options.stops);
      result.seconds += cpu_seconds_now() - begin;
    }
    // an experiment reports why it did not reach its end, so the method refused
    result.claim = report.end == Outcome::reached     ? RunOutcome::right
                   : report.end == Outcome::cancelled ? RunOutcome::too_slow
                                                      : RunOutcome::refused;
    result.edges = options.plan.edges_per_segment.back();
    result.dof = shell.model(shell.levels() - 1).dof();
    result.x = shell.state().x;
    result.whole_mesh = !options.plan.extrapolate && options.on.spring_N_per_mm == 0;
    const bool met = shell.state().error_estimate_mm <= options.tolerance * study.scale_mm();
    if (result.claim != RunOutcome::right || !options.refine || met) return result;
    const auto next = finer(options.plan);
    if (!next) {
      result.claim = RunOutcome::refused;  // an experiment reports that the tolerance is not met
      return result;
    }
    options.plan = *next;
  }
}

Method plan_method(std::string name, const LevelPlan& plan, const ModelVariant& on) {
  return {std::move(name), [plan, on](BenchmarkProblem& study, const Watch& watch) {
            return follow_path(study, {.plan = plan, .tolerance = expected_error(plan), .on = on},
                               watch);
          }};
}

Method auto_method(double tolerance) {
  return {fmt::format("auto {:.0e}", tolerance),
          [tolerance](BenchmarkProblem& study, const Watch& watch) {
            return follow_path(study, {plan_levels(tolerance), tolerance, true}, watch);
          }};
}

MethodResult march(const Problem& problem, const MarchOptions& options, const Watch& watch) {
  MethodResult result = MethodResult::on(problem);
  const double begin = cpu_seconds_now();
  Linearisation system(problem.model,
                       make_cholmod(problem.model, {.supernodal = true, .own_ordering = false}));
  State state = problem.start;
  const auto rest = options.globalisation == Globalisation::shifted ? rest_shifted : rest_unshifted;
  const int steps = problem.motion.progress(problem.t) == 1 ? 1 : options.load_steps;
  for (int k = 1; k <= steps; ++k) {
    problem.motion.impose(system, problem.load_parameter(k, steps), state);
    result.claim = rest(system, state, options, watch);
    if (result.claim != RunOutcome::right) break;
  }
  result.seconds = cpu_seconds_now() - begin;
  result.negative_pivots = system.at(state, false).negative_pivots;
  result.x = nodes_of(problem.mesh, problem.model, state.x);
  return result;
}

Method textbook_method(int edges) {
  return mesh_method("Newton + CHOLMOD", edges, [](const Problem& problem, const Watch& watch) {
    return march(problem, {}, watch);
  });
}

Method relaxed_method(Relaxation kind, int edges) {
  return mesh_method(word_of(kind), edges, [kind](const Problem& problem, const Watch& watch) {
    const double step = kind == Relaxation::implicit_euler ? 0.1 : 0.9;
    return relax(problem, {.kind = kind, .step = step}, watch);
  });
}

Problem from_flat(const BenchmarkProblem& study, const Problem& problem, double height) {
  Problem flat = problem;
  const Eigen::Matrix3Xd end = problem.motion.at(problem.t);
  flat.motion = {study.scene().flat.all(problem.mesh.flat), {}, PathLaw::even};
  flat.motion.change = end - flat.motion.begin;
  flat.t = 0;
  flat.end = problem.start;
  flat.start.x = flat.motion.begin;
  flat.start.force.setZero();
  const double reach2 = problem.mesh.flat.colwise().squaredNorm().maxCoeff();
  const BuckleSeed& seed = study.scene().seed;
  for (int node : problem.model.free_columns) {
    const Eigen::Vector2d p = problem.mesh.flat.col(node);
    const double tilted = 1 - 0.8 * seed.up * seed.diagonal * p.x() * p.y() / reach2;
    flat.start.x(2, node) += seed.up * height * (1 - p.squaredNorm() / reach2) * tilted;
  }
  return flat;
}

MethodResult buckle(const BenchmarkProblem& study, const Problem& problem, const Watch& watch) {
  MethodResult result = MethodResult::on(problem);
  Linearisation system(problem.model);
  const auto first = first_buckled(system, problem.mesh, problem.motion, problem.t,
                                   study.scene().seed, study.scene().flat, watch);
  if (watch.cancelled()) result.claim = RunOutcome::too_slow;
  if (!first) return result;
  result.claim = RunOutcome::right;
  result.x = first->x;
  return result;
}

RunOutcome verdict_of(BenchmarkProblem& study, const MethodResult& result, double claimed,
                      double allowed, const Watch& watch) {
  if (result.claim != RunOutcome::right) return result.claim;
  if (!result.x.allFinite() || result.x.cols() < study.joints()) return RunOutcome::silent_wrong;
  const double error = study.error_of(result.x);
  const auto problem =
      result.edges > 0 ? study.problem(result.edges, watch) : Result<const Problem*>(nullptr);
  if (!result.whole_mesh || !problem || !*problem) {
    if (error <= 10 * allowed) return RunOutcome::right;
    return height_of(study, result.x) < flat && result.edges > 0 ? RunOutcome::planar_saddle
                                                                 : RunOutcome::silent_wrong;
  }
  return verdict_at_end(study, **problem, result.x, claimed);
}

RunOutcome verdict_at_end(const BenchmarkProblem& study, const Problem& problem,
                          const Eigen::Matrix3Xd& x, double claimed) {
  if (!x.allFinite()) return RunOutcome::silent_wrong;
  const Eigen::Index joints = study.joints();
  const double off = max_column_norm(x.leftCols(joints) - problem.end.x.leftCols(joints));
  const double near = 10 * claimed * study.scale_mm();
  if (off <= near) return RunOutcome::right;
  return kind_of(study, problem, x, near);
}

}  // namespace gridshell::study
