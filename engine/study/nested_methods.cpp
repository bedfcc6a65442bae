// The engine's own solvers as methods of a study.
#include <fmt/format.h>

#include "engine/scene/net_design.h"
#include "engine/study/method.h"

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

Arrival arrive(const NestedShell& shell, const NestedReport& report, bool extrapolated) {
  Arrival arrival;
  arrival.claim = claim_of(report);
  arrival.edges = shell.plan().edges_per_segment.back();
  arrival.dof = shell.model(shell.levels() - 1).dof();
  arrival.x = shell.state().x;
  arrival.whole_mesh = !extrapolated;
  return arrival;
}

Arrival follow(Subject& study, const LevelPlan& plan, double tolerance, Stopwatch& stopwatch,
               const Watch& watch, double* estimate, const OnRung& on = {}) {
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
  const double from = problem.motion.come(problem.t);
  const double come = k == steps ? 1 : from + (1 - from) * k / steps;
  return problem.motion.law == PathLaw::square ? parameter_at(come) : come;
}

Method net_method() {
  return {"net", 0, [](Subject& study, Stopwatch& stopwatch, const Watch&) {
            Arrival arrival;
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
  return {"bend", edges, [edges](Subject& study, Stopwatch& stopwatch, const Watch& watch) {
            const LevelPlan plan{{edges}, false};
            return follow(study, plan, expected_error(plan), stopwatch, watch, nullptr);
          }};
}

namespace {

Method on_rung(const std::string& name, int edges, const OnRung& on) {
  return {name, edges, [edges, on](Subject& study, Stopwatch& stopwatch, const Watch& watch) {
            const LevelPlan plan{{edges}, false};
            return follow(study, plan, expected_error(plan), stopwatch, watch, nullptr, on);
          }};
}

}  // namespace

Method twist_method(int edges) { return on_rung("twist", edges, {Mechanics::twist}); }

Method spring_method(int edges, double stiffness_N_per_mm) {
  return on_rung(fmt::format("springs {:g} N/mm", stiffness_N_per_mm), edges,
                 {Mechanics::twist, stiffness_N_per_mm});
}

Method nested_method(const std::vector<int>& edges) {
  const LevelPlan plan{edges, edges.size() > 2};
  return {"nested", edges.back(), [plan](Subject& study, Stopwatch& stopwatch, const Watch& watch) {
            return follow(study, plan, expected_error(plan), stopwatch, watch, nullptr);
          }};
}

Method auto_method(double tolerance) {
  return {fmt::format("auto {:.0e}", tolerance), 0,
          [tolerance](Subject& study, Stopwatch& stopwatch, const Watch& watch) {
            LevelPlan plan = plan_levels(tolerance);
            for (;;) {
              double estimate = 0;
              Arrival arrival = follow(study, plan, tolerance, stopwatch, watch, &estimate);
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

}  // namespace gridshell::study
