#include "engine/study/benchmark_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/try.h"
#include "engine/preset/consistency.h"
#include "engine/scene/rod_ends.h"
#include "engine/simulate/indentation.h"
#include "engine/solve/buckling.h"
#include "engine/solve/equilibrium.h"

namespace gridshell::study {
namespace {

constexpr double first_shortening = 0.02;
constexpr double push_step = 0.02;  // over the length scale, as in experiments
constexpr double exact = 1e-8;      // tolerance of references, over the length scale

/// A mesh with its nodes on the net and its ghosts where the motion ends.
Result<State> on_net(const Scene& scene, const RodMesh& mesh, const Model& model,
                     const PinnedMotion& motion) {
  TRY(net, positions_on_net(scene, mesh));
  net->conservativeResize(3, mesh.nodes());
  net->rightCols(mesh.nodes_off_rods()) =
      motion.at(1).middleCols(mesh.rod_nodes(), mesh.nodes_off_rods());
  return start_state(model, columns_of(mesh, model, *net));
}

Error lost(const NestedReport& report, const char* where) {
  if (report.end == Outcome::cancelled) return stopped().value();
  return {Fault::no_equilibrium,
          fmt::format("the reference of the study {} (path parameter {:.4f}): choose a scene whose "
                      "path stays on one stable branch",
                      where, report.t)};
}

}  // namespace

double Problem::load_parameter(int k, int steps) const {
  const double from = motion.progress(t);
  const double come = k == steps ? 1 : from + (1 - from) * k / steps;
  return motion.law == PathLaw::square ? parameter_at(come) : come;
}

BenchmarkProblem::BenchmarkProblem(std::shared_ptr<const Scene> scene,
                                   const preset::Indentation& pushed)
    : scene_(std::move(scene)),
      pushed_(pushed),
      task_(pushed.requested() ? Task::push
            : scene_->from_net ? Task::near_net
                               : Task::actuation) {}

Result<std::unique_ptr<BenchmarkProblem>> BenchmarkProblem::create(const preset::Preset& preset,
                                                                   int finest, Watch& watch,
                                                                   double EA_scale) {
  TRY(scene, scene_of(preset));
  const auto refused = [](std::string why) { return invalid(std::move(why)); };
  if (scene->rod_model == RodModel::twist)
    return refused("a study compares methods on rods for which the bend model is exact: " +
                   preset::model_reason(preset));
  if (scene->rods.loaded())
    return refused(
        "a study compares methods on shells without [loads] that are supported at their ends "
        "alone");
  if (scene->from_drawing)
    return refused("a study compares methods on shells that begin flat or on a net");
  for (RodMaterial& material : scene->rods.materials) material.EA *= EA_scale;
  std::unique_ptr<BenchmarkProblem> made(
      new BenchmarkProblem(std::make_shared<const Scene>(std::move(*scene)), preset.indentation));
  TRY_DO(made->follow(finest, watch));
  return made;
}

Result<void> BenchmarkProblem::follow(int finest, Watch& watch) {
  LevelPlan plan{{4}, true};
  while (2 * plan.edges_per_segment.back() <= std::max(finest, 16))
    plan.edges_per_segment.push_back(2 * plan.edges_per_segment.back());
  NestedShell reference = shell(plan, exact);
  NestedReport report;
  if (scene_->from_net) {
    t_ = 1;
    TRY(net, on_net(*scene_, reference.finest(), reference.model(), reference.motion()));
    net = find_equilibrium(reference.system(), *net, 0.5 * scene_->footprint.spacing, watch);
    if (watch.cancelled()) return stopped();
    if (!net)
      return tl::unexpected<Error>(lost({Outcome::lost, 1}, "finds no equilibrium near the net"));
    report = reference.start(1, *net, watch);
  } else {
    TRY(t, parameter_of_shortening(reference.finest(), reference.motion(), first_shortening));
    if (*t >= 1)
      return invalid("the boundary shortens the rods by less than 2 %: too little for a study");
    t_ = *t;
    // as in experiments the coarsest mesh decides the branch
    TRY(first, first_buckled(reference.system(0), reference.mesh(0), reference.motion(0), t_,
                             scene_->seed, scene_->flat, watch));
    TRY(buckled, reference.refined(t_, *first, watch));
    report = reference.start(t_, *buckled, watch);
    if (report.end == Outcome::reached) start_ = reference.state().x;
    if (report.end == Outcome::reached) report = reference.advance(1, watch);
  }
  if (report.end != Outcome::reached)
    return tl::unexpected<Error>(lost(report, "is lost before its end"));
  finest_ = reference.mesh(reference.levels() - 1);
  if (task_ == Task::push) {
    start_ = reference.state().x;
    TRY(requested, simulate::push_of(pushed_, *scene_, reference));
    joint_ = requested->joint;
    displacement_ = requested->displacement;
    push(reference);
    report = go(reference, watch);
    if (report.end != Outcome::reached)
      return tl::unexpected<Error>(lost(report, "is lost under the push"));
  }
  end_ = reference.state().x;
  reference_error_ = reference.state().error_estimate_mm / scale_mm();
  return {};
}

void BenchmarkProblem::push(NestedShell& shell) const {
  shell.drive({.constraints = {Constraint{joint_}}, .displacements = {displacement_}});
}

ShellRods BenchmarkProblem::rods_on(const ModelVariant& on) const {
  constexpr double shear_over_young =
      31.0 / 83;  // Nitinol; the value has no effect on rods without natural twist
  ShellRods rods = scene_->rods;
  if (on.rod_model == RodModel::bend) return rods;
  for (RodMaterial& material : rods.materials) material.GJ = 2 * material.EI1 * shear_over_young;
  rods.joints = {.spring_N_per_mm = on.spring_N_per_mm};
  return rods;
}

NestedShell BenchmarkProblem::shell(const LevelPlan& plan, double tolerance,
                                    const ModelVariant& on) const {
  PathOptions options;
  options.spacing_mm = scene_->footprint.spacing;
  options.tolerance_mm = std::clamp(1e-3 * tolerance * scale_mm(), 1e-7, 1e-4);
  return NestedShell::make(scene_->footprint, rods_on(on), on.rod_model, scene_->motion, plan,
                           options)
      .value();
}

Problem BenchmarkProblem::on_model(const Problem& problem, const ModelVariant& on) const {
  Problem other = problem;
  other.model = build_model(problem.mesh, rods_on(on), on.rod_model).value();
  if (task_ == Task::push) other.model.pin(joint_);
  finish(other.model);
  const auto lifted = [&](const State& state) {
    State there = start_state(other.model, columns_of(problem.mesh, other.model, state.x));
    there.force = state.force;
    return there;
  };
  other.start = lifted(problem.start);
  other.end = lifted(problem.end);
  return other;
}

NestedReport BenchmarkProblem::begin(NestedShell& shell, const Watch& watch) {
  if (task_ == Task::near_net) return {Outcome::reached, 1};
  const auto known = problem(shell.plan().edges_per_segment.back(), watch);
  if (!known) return {Outcome::lost, t_};
  const Model& model = shell.model();
  State start = start_state(model, columns_of(shell.finest(), model, (*known)->start.x));
  start.force = (*known)->start.force;
  if (task_ == Task::actuation) return shell.start_path(t_, start);
  const NestedReport report = shell.start(1, start, watch);
  if (report.end == Outcome::reached) push(shell);
  return report;
}

NestedReport BenchmarkProblem::go(NestedShell& shell, const Watch& watch, int stops) const {
  if (task_ == Task::actuation) {
    NestedReport report{Outcome::reached, t_};
    const double from = progress_at(t_);
    for (int k = 1; k <= stops && report.end == Outcome::reached; ++k)
      report = shell.advance(k == stops ? 1 : parameter_at(from + (1 - from) * k / stops), watch);
    return report;
  }
  if (task_ == Task::near_net) {
    auto net = on_net(*scene_, shell.finest(), shell.model(), shell.motion());
    if (net) net = find_equilibrium(shell.system(), *net, 0.5 * scene_->footprint.spacing, watch);
    if (!net) return {watch.cancelled() ? Outcome::cancelled : Outcome::lost, 1};
    return shell.start(1, *net, watch);
  }
  const int steps = std::max(1, int(std::ceil(displacement_.norm() / (push_step * scale_mm()))));
  NestedReport report = shell.start(0, shell.state().levels.back(), watch);
  for (int k = 1; k <= steps && report.end == Outcome::reached; ++k)
    report = shell.advance(double(k) / steps, watch);
  return report;
}

Result<State> BenchmarkProblem::equilibrium_near(const Problem& problem,
                                                 const Eigen::Matrix3Xd& requested, double t,
                                                 const Watch& watch) const {
  Eigen::Matrix3Xd x;
  MeshTransfer(finest_, problem.mesh).nodes(requested, x);
  Linearisation system(problem.model);
  State state = start_state(problem.model, x);
  problem.motion.impose(system, t, state);
  const double near = 0.5 * scene_->footprint.spacing;
  const auto found = gridshell::find_equilibrium(system, state, near, watch);
  if (watch.cancelled()) return stopped();
  if (found && max_column_norm(found->x.leftCols(joints()) - requested.leftCols(joints())) < near)
    return found;
  return fail(Fault::no_equilibrium,
              "{} edges per segment have no stable state near the reference's", problem.edges);
}

Result<const Problem*> BenchmarkProblem::problem(int edges, const Watch& watch) {
  const std::lock_guard lock(mutex_);
  if (const auto known = problems_.find(edges); known != problems_.end()) return &known->second;
  const NestedShell one = shell({{edges}, false}, exact);
  Problem problem{edges, one.mesh(0), one.model(0), one.motion(0), t_, {}, {}};
  if (task_ == Task::near_net) {
    TRY(net, on_net(*scene_, problem.mesh, problem.model, problem.motion));
    problem.start = std::move(*net);
  } else {
    TRY(start, equilibrium_near(problem, start_, task_ == Task::push ? 1 : t_, watch));
    problem.start = std::move(*start);
  }
  if (task_ == Task::push) {
    problem.model.pin(joint_);
    finish(problem.model);
    problem.motion = {problem.start.x, Eigen::Matrix3Xd::Zero(3, problem.model.nodes),
                      PathLaw::even};
    problem.motion.change.col(joint_) = displacement_;
    problem.t = 0;
  }
  TRY(end, equilibrium_near(problem, end_, 1, watch));
  problem.end = std::move(*end);
  return &problems_.emplace(edges, std::move(problem)).first->second;
}

double BenchmarkProblem::error_of(const Eigen::Matrix3Xd& x) const {
  return max_column_norm(x.leftCols(joints()) - end_.leftCols(joints())) / scale_mm();
}

}  // namespace gridshell::study
