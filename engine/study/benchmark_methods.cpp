// The engine's own solvers as methods of a study.

#include "engine/study/benchmark_methods.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/scene/net_design.h"

namespace gridshell::study {
namespace {

using record::RunOutcome;

RunOutcome claim_of(const NestedReport& report) {
  switch (report.end) {
    case Outcome::reached:
      return RunOutcome::right;
    case Outcome::cancelled:
      return RunOutcome::too_slow;
    case Outcome::unstable:
    case Outcome::lost:
    case Outcome::folded:
    case Outcome::not_finite:
    case Outcome::not_converged:
    case Outcome::meshes_disagree:
    case Outcome::locked:
      break;
  }
  return RunOutcome::refused;  // the report names the reason
}

MethodResult arrive(const NestedShell& shell, const NestedReport& report, bool extrapolated) {
  MethodResult arrival;
  arrival.claim = claim_of(report);
  arrival.edges = shell.plan().edges_per_segment.back();
  arrival.dof = shell.model(shell.levels() - 1).dof();
  arrival.x = shell.state().x;
  arrival.whole_mesh = !extrapolated;
  return arrival;
}

MethodResult follow(BenchmarkProblem& study, const LevelPlan& plan, double tolerance,
                    Stopwatch& stopwatch, const Watch& watch, double* estimate,
                    const ModelVariant& on = {}) {
  stopwatch.start();
  NestedShell shell = study.shell(plan, tolerance, on);
  stopwatch.stop();
  NestedReport report = study.begin(shell, watch);
  if (report.end == Outcome::reached) {
    stopwatch.start();
    report = study.go(shell, watch);
    stopwatch.stop();
  }
  if (estimate) *estimate = shell.state().error_estimate_mm / study.scale_mm();
  return arrive(shell, report, plan.extrapolate || on.spring_N_per_mm > 0);
}

}  // namespace

double load_parameter(const Problem& problem, int k, int steps) {
  const double from = problem.motion.progress(problem.t);
  const double come = k == steps ? 1 : from + (1 - from) * k / steps;
  return problem.motion.law == PathLaw::square ? parameter_at(come) : come;
}

Method net_method() {
  return {"net", 0, [](BenchmarkProblem& study, Stopwatch& stopwatch, const Watch&) {
            MethodResult arrival;
            arrival.claim = RunOutcome::refused;
            const auto& scene = study.scene();
            if (!scene.net || study.task() == Task::push) return arrival;
            stopwatch.start();
            Eigen::Matrix2Xd uv(2, study.joints());
            for (int k = 0; k < study.joints(); ++k)
              uv.col(k) << scene.footprint.joints[std::size_t(k)].u,
                  scene.footprint.joints[std::size_t(k)].v;
            auto net = points_on(*scene.net, uv);
            stopwatch.stop();
            if (!net) return arrival;
            arrival.claim = RunOutcome::right;
            arrival.x = std::move(*net);
            arrival.dof = 3 * study.joints();
            return arrival;
          }};
}

Method bend_method(int edges) {
  return {"bend", edges,
          [edges](BenchmarkProblem& study, Stopwatch& stopwatch, const Watch& watch) {
            const LevelPlan plan{{edges}, false};
            return follow(study, plan, expected_error(plan), stopwatch, watch, nullptr);
          }};
}

namespace {

Method on_model(const std::string& name, int edges, const ModelVariant& on) {
  return {name, edges,
          [edges, on](BenchmarkProblem& study, Stopwatch& stopwatch, const Watch& watch) {
            const LevelPlan plan{{edges}, false};
            return follow(study, plan, expected_error(plan), stopwatch, watch, nullptr, on);
          }};
}

}  // namespace

Method twist_method(int edges) { return on_model("twist", edges, {RodModel::twist}); }

Method spring_method(int edges, double stiffness_N_per_mm) {
  return on_model(fmt::format("springs {:g} N/mm", stiffness_N_per_mm), edges,
                  {RodModel::twist, stiffness_N_per_mm});
}

Method nested_method(const std::vector<int>& edges) {
  const LevelPlan plan{edges, edges.size() > 2};
  return {"nested", edges.back(),
          [plan](BenchmarkProblem& study, Stopwatch& stopwatch, const Watch& watch) {
            return follow(study, plan, expected_error(plan), stopwatch, watch, nullptr);
          }};
}

Method auto_method(double tolerance) {
  return {fmt::format("auto {:.0e}", tolerance), 0,
          [tolerance](BenchmarkProblem& study, Stopwatch& stopwatch, const Watch& watch) {
            LevelPlan plan = plan_levels(tolerance);
            for (;;) {
              double estimate = 0;
              MethodResult arrival = follow(study, plan, tolerance, stopwatch, watch, &estimate);
              if (arrival.claim != RunOutcome::right || estimate <= tolerance) return arrival;
              const auto next = finer(plan);
              if (!next) {
                arrival.claim = RunOutcome::refused;  // the tolerance is not met, and it says so
                return arrival;
              }
              plan = *next;
            }
          }};
}

// Newton's method the textbook's way.

namespace {

using record::RunOutcome;

/// Full or shortened Newton steps on the energy's Hessian, whatever its inertia.
RunOutcome rest_unshifted(Linearisation& system, State& state, const MarchOptions& options,
                          const Watch& watch) {
  Eigen::Matrix3Xd dx;
  State trial;
  Assembly there;
  for (int k = 0; k < options.most_iterations; ++k) {
    if (watch.cancelled()) return RunOutcome::too_slow;
    if (!system.at(state, false, 0, options.EA_scale).usable) return RunOutcome::blow_up;
    system.correction(dx);
    const double move = max_column_norm(dx);
    if (!std::isfinite(move) || !std::isfinite(system.assembly().energies.total()))
      return RunOutcome::blow_up;
    double factor = 1;
    if (options.globalisation == Globalisation::line_search) {
      // the residual falls along Newton's direction, whatever the inertia
      const auto unbalanced = [&](Eigen::Matrix3Xd gradient) {
        clear_held(system.model(), gradient);
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

/// The Hessian shifted until it is positive definite, the step shortened until the energy falls.
RunOutcome rest_shifted(Linearisation& system, State& state, const MarchOptions& options,
                        const Watch& watch) {
  const auto energy_at = [&](const State& at) {
    Energies energies = energies_of(system.model(), at, system.outside);
    energies[Term::stretch] *= options.EA_scale;
    return energies.total();
  };
  Eigen::Matrix3Xd dx;
  State trial;
  double shift = 0;
  for (int k = 0; k < options.most_iterations; ++k) {
    if (watch.cancelled()) return RunOutcome::too_slow;
    Inertia inertia = system.at(state, false, shift, options.EA_scale);
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

RunOutcome rest(Linearisation& system, State& state, const MarchOptions& options,
                const Watch& watch) {
  return options.globalisation == Globalisation::shifted
             ? rest_shifted(system, state, options, watch)
             : rest_unshifted(system, state, options, watch);
}

}  // namespace

const char* name_of(Globalisation globalisation) {
  switch (globalisation) {
    case Globalisation::none:
      return "full steps";
    case Globalisation::line_search:
      return "line search";
    case Globalisation::shifted:
      break;
  }
  return "shifted";
}

MethodResult march(const Problem& problem, const MarchOptions& options, Stopwatch& stopwatch,
                   const Watch& watch) {
  MethodResult arrival;
  arrival.edges = problem.edges;
  arrival.dof = problem.model.dof();
  arrival.whole_mesh = options.EA_scale == 1;
  stopwatch.start();
  Linearisation system(problem.model,
                       make_cholmod(problem.model, {.supernodal = true, .own_ordering = false}));
  State state = problem.start;
  const int steps = problem.motion.progress(problem.t) == 1 ? 1 : options.load_steps;
  for (int k = 1; k <= steps; ++k) {
    problem.motion.impose(system, load_parameter(problem, k, steps), state);
    arrival.claim = rest(system, state, options, watch);
    if (arrival.claim != RunOutcome::right) break;
  }
  stopwatch.stop();
  arrival.negative_pivots = system.at(state, false).negative_pivots;
  arrival.x = nodes_of(problem.mesh, problem.model, state.x);
  return arrival;
}

Method textbook_method(int edges) {
  return {
      "Newton + CHOLMOD", edges,
      [edges](BenchmarkProblem& study, Stopwatch& stopwatch, const Watch& watch) -> MethodResult {
        const auto problem = study.problem(edges, watch);
        if (!problem) return {RunOutcome::refused, {}, false, 0, 0, 0};
        return march(**problem, {}, stopwatch, watch);
      }};
}

namespace {

using record::RunOutcome;

constexpr double flat = 1e-3;  // of the length scale

/// Height of the joints above one another, over the length scale.
double height_of(const BenchmarkProblem& study, const Eigen::Matrix3Xd& x) {
  const auto z = x.leftCols(study.joints()).row(2);
  return (z.maxCoeff() - z.minCoeff()) / study.scale_mm();
}

/// What a state that is not the right one is on its own mesh.
RunOutcome kind_of(const BenchmarkProblem& study, const Problem& problem, const Eigen::Matrix3Xd& x,
                   double near_mm) {
  if (height_of(study, x) < flat && height_of(study, problem.end.x) > 10 * flat)
    return RunOutcome::planar_saddle;
  // an equilibrium of another boundary is none of this one
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

}  // namespace

RunOutcome verdict_of(BenchmarkProblem& study, const MethodResult& arrival, double claimed,
                      double allowed, const Watch& watch) {
  if (arrival.claim != RunOutcome::right) return arrival.claim;
  if (!arrival.x.allFinite() || arrival.x.cols() < study.joints()) return RunOutcome::silent_wrong;
  const double error = study.error_of(arrival.x);
  const auto problem =
      arrival.edges > 0 ? study.problem(arrival.edges, watch) : Result<const Problem*>(nullptr);
  if (!arrival.whole_mesh || !problem || !*problem) {
    if (error <= 10 * allowed) return RunOutcome::right;
    return height_of(study, arrival.x) < flat && arrival.edges > 0 ? RunOutcome::planar_saddle
                                                                   : RunOutcome::silent_wrong;
  }
  return verdict_at_end(study, **problem, arrival.x, claimed);
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
