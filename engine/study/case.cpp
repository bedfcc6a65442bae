#include "engine/study/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/experiment/indentation.h"
#include "engine/experiment/net_design.h"
#include "engine/experiment/scene.h"
#include "engine/measure/gauss.h"
#include "engine/preset/rung.h"
#include "engine/solve/buckle.h"
#include "engine/solve/minimise.h"

namespace gridshell::study {
namespace {

constexpr double first_shortening = 0.02;
constexpr double push_step = 0.02;  // of the length scale, as in the experiment
constexpr double exact = 1e-8;      // tolerance of references, over the length scale

/// The net's places of a mesh's nodes; ghosts where the motion ends.
Result<State> on_net(const experiment::ActuationScene& scene, const RodMesh& mesh,
                     const PinnedMotion& motion, std::size_t edges) {
  auto net = experiment::sample(*scene.net, mesh.flat.leftCols(mesh.rod_nodes()));
  if (!net) return tl::unexpected<Error>(net.error());
  net->conservativeResize(3, mesh.nodes());
  net->rightCols(mesh.ghosts) = motion.at(1).rightCols(mesh.ghosts);
  return State{*net, Eigen::VectorXd::Zero(Eigen::Index(edges))};
}

/// Full steps, or the way down where those lead elsewhere. True: at rest and stable.
bool bring_to_rest(Linearisation& system, State& state, double farthest_mm, const Watch& watch) {
  NewtonOptions options;
  options.tolerance_mm = 1e-7;
  options.farthest_mm = farthest_mm;
  State found = state;
  NewtonReport report = newton(system, found, options);
  if (report.outcome != NewtonOutcome::converged || !system.at(found, false).positive_definite()) {
    found = state;
    report = minimise(system, found, {.tolerance_mm = 1e-6}, watch);
    if (report.outcome != NewtonOutcome::converged) return false;
    newton(system, found, options);
  }
  state = std::move(found);
  return true;
}

void pin(Model& model, int node) {
  model.pinned[std::size_t(node)] = 1;
  model.free_nodes.clear();
  for (int k = 0; k < model.nodes; ++k) {
    model.free_index[std::size_t(k)] = model.pinned[std::size_t(k)] ? -1 : model.free();
    if (!model.pinned[std::size_t(k)]) model.free_nodes.push_back(k);
  }
}

Error lost(const NestedReport& report, const char* where) {
  if (report.end == NestedEnd::cancelled) return {Fault::cancelled, "stopped"};
  return {Fault::no_equilibrium,
          fmt::format("the reference of the study {} (path parameter {:.4f}): choose a scene whose "
                      "path stays on one stable branch",
                      where, report.t)};
}

}  // namespace

Result<std::unique_ptr<Case>> Case::create(const preset::Preset& preset, int finest, Watch& watch,
                                           double EA_scale) {
  std::unique_ptr<Case> made(new Case);
  if (auto ready = made->set_up(preset); !ready) return tl::unexpected<Error>(ready.error());
  for (RodSection& section : made->scene_.rods.sections) section.EA *= EA_scale;
  if (auto followed = made->follow(finest, watch); !followed)
    return tl::unexpected<Error>(followed.error());
  return made;
}

Result<void> Case::set_up(const preset::Preset& preset) {
  auto scene = experiment::scene_of(preset);
  if (!scene) return tl::unexpected<Error>(scene.error());
  scene_ = std::move(*scene);
  if (preset::rung_of(preset) == preset::Rung::twist)
    return fail(Fault::bad_input,
                "a study compares methods on rods for which the bend rung is "
                "exact: " +
                    preset::model_reason(preset));
  if (scene_.rods.loaded())
    return fail(Fault::bad_input, "[loads]: a study compares methods on shells without dead loads");
  pushed_ = preset.indentation;
  task_ = pushed_.wanted() ? Task::push : scene_.from_net ? Task::beside_net : Task::actuation;
  return {};
}

Result<void> Case::follow(int finest, Watch& watch) {
  LevelPlan plan{{4}, true};
  while (2 * plan.edges_per_segment.back() <= std::max(finest, 16))
    plan.edges_per_segment.push_back(2 * plan.edges_per_segment.back());
  NestedShell reference = shell(plan, exact);
  NestedReport report;
  if (scene_.from_net) {
    t_ = 1;
    auto net =
        on_net(scene_, reference.mesh(0), reference.motion(0), reference.model(0).edges.size());
    if (!net) return tl::unexpected<Error>(net.error());
    if (!bring_to_rest(reference.system(0), *net, 0.5 * scene_.footprint.spacing, watch))
      return tl::unexpected<Error>(lost({NestedEnd::lost, 1}, "finds no rest beside the net"));
    report = reference.start(1, *net, watch);
  } else {
    const auto t =
        parameter_of_shortening(reference.mesh(0), reference.motion(0), first_shortening);
    if (!t) return tl::unexpected<Error>(t.error());
    if (*t >= 1)
      return fail(Fault::bad_input,
                  "the boundary shortens the rods by less than 2 %: too little "
                  "for a study");
    t_ = *t;
    auto first = first_buckled(reference.system(0), reference.mesh(0), reference.motion(0), t_,
                               scene_.seed, scene_.flat, watch);
    if (!first) return tl::unexpected<Error>(first.error());
    report = reference.start(t_, *first, watch);
    if (report.end == NestedEnd::reached) start_ = reference.state().x;
    if (report.end == NestedEnd::reached) report = reference.advance(1, watch);
  }
  if (report.end != NestedEnd::reached)
    return tl::unexpected<Error>(lost(report, "is lost on the way"));
  finest_ = reference.mesh(reference.levels() - 1);
  if (task_ == Task::push) {
    start_ = reference.state().x;
    if (auto found = find_push(pushed_, reference); !found) return found;
    push(reference);
    report = go(reference, watch);
    if (report.end != NestedEnd::reached)
      return tl::unexpected<Error>(lost(report, "is lost under the push"));
  }
  end_ = reference.state().x;
  reference_error_ = reference.state().error_estimate_mm / scale_mm();
  return {};
}

Result<void> Case::find_push(const preset::Indentation& asked, const NestedShell& shell) {
  const Eigen::Matrix3Xd& x = shell.state().x;
  Eigen::Matrix3Xd places = x.leftCols(joints());
  if (scene_.net) {
    Eigen::Matrix2Xd uv(2, joints());
    for (int k = 0; k < joints(); ++k)
      uv.col(k) << scene_.footprint.joints[std::size_t(k)].u,
          scene_.footprint.joints[std::size_t(k)].v;
    auto net = experiment::sample(*scene_.net, uv);
    if (!net) return tl::unexpected<Error>(net.error());
    places = *net;
  }
  const auto joint = experiment::pushed_joint(asked, scene_.footprint, places);
  if (!joint) return tl::unexpected<Error>(joint.error());
  joint_ = *joint;
  Eigen::Vector3d along;
  if (scene_.net) {
    const FootprintJoint& at = scene_.footprint.joints[std::size_t(joint_)];
    const auto point = scene_.net->at(at.u, at.v);
    if (!point) return tl::unexpected<Error>(point.error());
    along = point->normal();
  } else {
    const JointTangents tangents = joint_tangents(scene_.footprint, finest_, x);
    along = tangents.u.col(joint_).cross(tangents.v.col(joint_)).normalized();
  }
  if (asked.direction == preset::Direction::inward) along = -along;
  displacement_ = (asked.depth_mm > 0 ? asked.depth_mm : asked.depth * scale_mm()) * along;
  return {};
}

void Case::push(NestedShell& shell) const {
  shell.push_joint({joint_, Eigen::Matrix3Xd::Identity(3, 3)}, displacement_);
}

NestedShell Case::shell(const LevelPlan& plan, double tolerance) const {
  PathOptions options;
  options.spacing_mm = scene_.footprint.spacing;
  options.tolerance_mm = std::clamp(1e-3 * tolerance * scale_mm(), 1e-7, 1e-4);
  return NestedShell(scene_.footprint, scene_.rods, scene_.motion, plan, options);
}

NestedReport Case::begin(NestedShell& shell, const Watch& watch) {
  if (task_ == Task::beside_net) return {NestedEnd::reached, 1};
  const auto coarse = problem(shell.plan().edges_per_segment.front(), watch);
  if (!coarse) return {NestedEnd::lost, t_};
  if (task_ == Task::actuation) return shell.place(t_, (*coarse)->start);
  const NestedReport report = shell.start(1, (*coarse)->start, watch);
  if (report.end == NestedEnd::reached) push(shell);
  return report;
}

NestedReport Case::go(NestedShell& shell, const Watch& watch) const {
  if (task_ == Task::actuation) return shell.advance(1, watch);
  if (task_ == Task::beside_net) {
    auto net = on_net(scene_, shell.mesh(0), shell.motion(0), shell.model(0).edges.size());
    if (!net || !bring_to_rest(shell.system(0), *net, 0.5 * scene_.footprint.spacing, watch))
      return {watch.cancelled() ? NestedEnd::cancelled : NestedEnd::lost, 1};
    return shell.start(1, *net, watch);
  }
  const int steps = std::max(1, int(std::ceil(displacement_.norm() / (push_step * scale_mm()))));
  NestedReport report = shell.start(0, shell.state().levels[0], watch);
  for (int k = 1; k <= steps && report.end == NestedEnd::reached; ++k)
    report = shell.advance(double(k) / steps, watch);
  return report;
}

Result<State> Case::rest_near(const Problem& problem, const Eigen::Matrix3Xd& wanted, double t,
                              const Watch& watch) const {
  State state{{}, Eigen::VectorXd::Zero(Eigen::Index(problem.model.edges.size()))};
  MeshTransfer(finest_, problem.mesh).nodes(wanted, state.x);
  Linearisation system(problem.model);
  problem.motion.impose(system, t, state.x);
  const double near = 0.5 * scene_.footprint.spacing;
  const bool found = bring_to_rest(system, state, near, watch) &&
                     largest_column(state.x.leftCols(joints()) - wanted.leftCols(joints())) < near;
  if (watch.cancelled()) return fail(Fault::cancelled, "stopped");
  if (found) return state;
  return fail(
      Fault::no_equilibrium,
      fmt::format("{} edges a segment have no stable state near the reference's", problem.edges));
}

Result<const Problem*> Case::problem(int edges, const Watch& watch) {
  const std::lock_guard lock(mutex_);
  if (const auto known = problems_.find(edges); known != problems_.end()) return &known->second;
  const NestedShell one = shell({{edges}, false}, exact);
  Problem problem{edges, one.mesh(0), one.model(0), one.motion(0), t_, {}, {}};
  if (task_ == Task::beside_net) {
    auto net = on_net(scene_, problem.mesh, problem.motion, problem.model.edges.size());
    if (!net) return tl::unexpected<Error>(net.error());
    problem.start = std::move(*net);
  } else {
    auto start = rest_near(problem, start_, task_ == Task::push ? 1 : t_, watch);
    if (!start) return tl::unexpected<Error>(start.error());
    problem.start = std::move(*start);
  }
  if (task_ == Task::push) {
    pin(problem.model, joint_);
    problem.motion = {problem.start.x, Eigen::Matrix3Xd::Zero(3, problem.model.nodes), Pace::even};
    problem.motion.change.col(joint_) = displacement_;
    problem.t = 0;
  }
  auto end = rest_near(problem, end_, 1, watch);
  if (!end) return tl::unexpected<Error>(end.error());
  problem.end = std::move(*end);
  return &problems_.emplace(edges, std::move(problem)).first->second;
}

double Case::error_of(const Eigen::Matrix3Xd& x) const {
  return largest_column(x.leftCols(joints()) - end_.leftCols(joints())) / scale_mm();
}

}  // namespace gridshell::study
