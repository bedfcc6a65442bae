// Does edits as steps of a preset, and stores the steps, so that a preset can repeat them.

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/window/command.h"
#include "app/window/edit_session.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"

namespace gridshell::window {
namespace {

/// A vector for a preset; components that are only round-off become 0.
std::vector<double> xyz_of(const Eigen::Vector3d& vector) {
  std::vector<double> xyz;
  for (const double value : vector) xyz.push_back(std::abs(value) < nearest_mm ? 0 : value);
  return xyz;
}

/// The dragged edge points, as [[step]] edge_points has them: index and displacement.
preset::Points rows_of(const Eigen::Matrix3Xd& dragged) {
  preset::Points rows;
  for (Eigen::Index k = 0; k < dragged.cols(); ++k)
    if (!dragged.col(k).isZero(0))
      rows.push_back({double(k), dragged(0, k), dragged(1, k), dragged(2, k)});
  return rows;
}

// coarsest meshes with fewer nodes (some 30 rods per direction) are solved at positions in between
constexpr Eigen::Index most_nodes_marked = 8000;
constexpr double same_shape = 2e-3;             // of the length scale
constexpr double part_mm = 1, most_parts = 12;  // parts in which a long push is done
constexpr double free_fraction = 0.8;           // of the last step of a drag to the strain limit
constexpr const char* resisting = "the joint resists: the rods are near their strain limit";

preset::Step step_of(preset::StepKind kind) {
  preset::Step step;
  step.kind = kind;
  return step;
}

preset::Step step_of(preset::StepKind kind, const FootprintJoint& joint) {
  preset::Step step = step_of(kind);
  step.joint = {joint.i, joint.j};
  return step;
}

/// Whether a step continues the one before, so that it can replace it.
bool continues(const preset::Step& before, const preset::Step& step) {
  if (before.kind != step.kind) return false;
  if (step.kind == preset::StepKind::move)
    return before.edge_points.empty() && step.edge_points.empty();
  return step.kind == preset::StepKind::push && before.joint == step.joint && !step.along.empty() &&
         before.along == step.along;
}

}  // namespace

/// Does one step, as a run of a preset does it, and stores it.
Result<void> EditSession::do_step(preset::Step step, const Watch& watch) {
  const bool constrains =
      step.kind == preset::StepKind::push || step.kind == preset::StepKind::hold;
  if (constrains)
    if (const auto joint = joint_named(now_.scene->footprint, step.joint))
      // the position in the view, which the coarse mesh of a drag has not changed yet
      session_->constraint_origins.emplace(*joint,
                                           view_.frame.nodes.cols() > *joint
                                               ? Eigen::Vector3d(view_.frame.nodes.col(*joint))
                                               : Eigen::Vector3d(session_->nodes().col(*joint)));
  // before a snap the shell is solved on all meshes, as in a run
  const bool snaps = step.kind == preset::StepKind::jitter || step.kind == preset::StepKind::rest ||
                     step.kind == preset::StepKind::release;
  // ... unless finer meshes do not have this state
  if (snaps && session_->shell().levels() == 1)
    (void)session_->remesh(simulate::initial_levels(*now_.scene), watch);
  const bool began_stable = view_.stable();
  const double began_mm = pushed_mm(step);
  // a drag past the limit of strain or stiffness would leave a shell that no further step can move
  std::optional<Checkpoint> before;
  if (passing_ && step.kind == preset::StepKind::push) before = session_->save();
  simulate::PathSegment path;
  TRY(report, simulate::apply_step(*session_, step, watch, looks_between() ? &path : nullptr));
  if (before && report->end == Outcome::locked) {
    const auto joint = joint_named(now_.scene->footprint, step.joint);
    return resist(std::move(step), *before, session_->nodes().col(*joint), watch);
  }
  const std::string event_at = note_path(step, path, began_mm, began_stable, *report);
  add_step(std::move(step), *report);
  const auto done = note_events(*report);
  if (!event_at.empty()) view_.event = view_.message += " at " + event_at;
  // stability may have been lost and regained on the path
  const auto lost = [](const Event& e) { return e.kind == Event::Kind::stability_lost && !e.to; };
  if (!event_at.empty() && report->end == Outcome::reached && report->certificate.stable() &&
      std::ranges::all_of(report->events, lost))
    view_.event = view_.message = "stable again; on the path " + view_.message;
  return done;
}

/// Moves a dragged joint by a fraction of the distance to the position in which the rods reached
/// their strain limit. It remains there until it is dragged back.
Result<void> EditSession::resist(preset::Step step, const Checkpoint& before,
                                 const Eigen::Vector3d& reached, const Watch& watch) {
  const auto joint = joint_named(now_.scene->footprint, step.joint);
  session_->restore(before);
  const Eigen::Vector3d from = session_->nodes().col(*joint),
                        to = from + free_fraction * (reached - from);
  step.to_mm = xyz_of(to);
  TRY(report, simulate::apply_step(*session_, step, watch, nullptr));
  const bool moved = report->end == Outcome::reached;
  if (!moved) session_->restore(before);
  if (moved) {
    add_step(std::move(step), *report);
    TRY_DO(note_events(*report));
  }
  stop_ = {this_drag_, moved ? to : from, from - (reached - from)};
  view_.message = resisting;
  return {};
}

/// Whether a drag that was stopped at the strain limit continues in that direction.
bool EditSession::resists(const Eigen::Vector3d& to) {
  if (!passing_ || stop_.drag != this_drag_) return false;
  if ((to - stop_.at).dot(stop_.at - stop_.from) >= 0) return true;
  if (view_.message == resisting) view_.message.clear();
  return false;
}

/// Stores a step; one that ended early is stored up to its last state.
void EditSession::add_step(preset::Step step, const Report& report) {
  if (report.end != Outcome::reached) {
    if (step.kind != preset::StepKind::move && step.kind != preset::StepKind::push) return;
    step.progress = session_->progress();
    if (step.kind == preset::StepKind::push)
      if (const auto joint = joint_named(now_.scene->footprint, step.joint))
        step.to_mm = xyz_of(session_->nodes().col(*joint));
  }
  if (step.kind == preset::StepKind::move) step.edge_points = rows_of(session_->dragged());
  const bool eventful = !report.events.empty() || !view_.event.empty();
  const bool same = this_drag_ != 0 && this_drag_ == steps_drag_ && !now_.steps.empty() &&
                    !eventful && !last_eventful_ && continues(*now_.steps.back(), step);
  if (same) now_.steps.pop_back();
  now_.steps.push_back(std::make_shared<const preset::Step>(std::move(step)));
  steps_drag_ = this_drag_;
  last_eventful_ = eventful;
}

Result<void> EditSession::move_boundary(double progress, const Eigen::Matrix3Xd& dragged,
                                        const Watch& watch) {
  preset::Step step = step_of(preset::StepKind::move);
  step.progress = progress;
  step.edge_points = rows_of(dragged);
  return do_step(std::move(step), watch);
}

Result<void> EditSession::act(const Move& command, const Watch& watch) {
  return move_boundary(std::max(command.progress, view_.least_progress), session_->dragged(),
                       watch);
}

Result<void> EditSession::act(const DragEdge& command, const Watch& watch) {
  Eigen::Matrix3Xd dragged = session_->dragged();
  const Eigen::Index k = command.edge_point;
  if (k < 0 || k >= dragged.cols()) return invalid("no such edge point");
  const BoundaryMotion& motion = now_.scene->motion;
  const double progress = session_->progress();
  dragged.col(k) = command.to - motion.begin.col(k) - progress * (motion.end - motion.begin).col(k);
  if ((dragged - session_->dragged()).norm() < nearest_mm) return {};
  return move_boundary(progress, dragged, watch);
}

Result<void> EditSession::act(const ResetEdgePoint& command, const Watch& watch) {
  Eigen::Matrix3Xd dragged = session_->dragged();
  if (command.edge_point < 0)
    dragged.setZero();
  else if (command.edge_point < dragged.cols())
    dragged.col(command.edge_point).setZero();
  if (dragged == session_->dragged()) return invalid("no such edge point was dragged");
  return move_boundary(session_->progress(), dragged, watch);
}

Result<void> EditSession::act(const Push& command, const Watch& watch) {
  const auto& joints = now_.scene->footprint.joints;
  if (command.joint < 0 || command.joint >= int(joints.size())) return invalid("no such joint");
  if (resists(command.to)) return {};
  preset::Step step = step_of(preset::StepKind::push, joints[std::size_t(command.joint)]);
  step.to_mm = xyz_of(command.to);
  const bool free = !command.along.isZero(0);
  if (free) step.along = xyz_of(command.along);
  step.lateral = free ? preset::Lateral::free : preset::Lateral::held;
  // a joint that is already constrained and does not move makes no step
  const Eigen::Vector3d displacement = command.to - session_->nodes().col(command.joint);
  const bool still =
      (free ? std::abs(displacement.dot(command.along)) : displacement.norm()) < nearest_mm;
  if (still && session_->constraint_origins.contains(command.joint)) return {};
  // a long push that was typed is done in parts, so that it shows equilibria as a drag does
  const bool dragged = this_drag_ == 0 || this_drag_ == steps_drag_;
  const int parts =
      dragged || !looks_between()
          ? 1
          : int(std::clamp(std::round(displacement.norm() / part_mm), 1.0, most_parts));
  for (int k = 1; k < parts; ++k) {
    step.to_mm = xyz_of(command.to - (1 - double(k) / parts) * displacement);
    TRY_DO(do_step(step, watch));
    now_.refined = false;
    update_view();
    if (listener_) listener_(view_);
    view_.push_path.push_back(plot_point_of(view_));
  }
  step.to_mm = xyz_of(command.to);
  return do_step(std::move(step), watch);
}

/// Whether equilibria between the ends of a step are computed and marked: not for a large shell,
/// where a single one takes long.
bool EditSession::looks_between() const {
  return session_->shell().mesh(0).rod_nodes() < most_nodes_marked;
}

Result<void> EditSession::act(const Release& command, const Watch& watch) {
  if (session_->constraints().empty()) return invalid("no joint is fixed");
  if (command.joint >= int(now_.scene->footprint.joints.size())) return invalid("no such joint");
  std::vector<int> joints{command.joint};
  if (command.joint < 0) {
    joints.clear();
    for (const Constraint& constraint : session_->constraints()) joints.push_back(constraint.node);
  }
  for (const int k : joints)
    TRY_DO(do_step(step_of(preset::StepKind::release, now_.scene->footprint.joints[std::size_t(k)]),
                   watch));
  return {};
}

Result<void> EditSession::act(const Rest& command, const Watch& watch) {
  preset::Step step = step_of(preset::StepKind::rest);
  step.side = command.side;
  return do_step(std::move(step), watch);
}

Result<void> EditSession::act(const Jitter& command, const Watch& watch) {
  // the state that a perturbed shell reaches depends on round-off; on the meshes of a run it is the
  // one that the run reaches
  refine(watch);
  preset::Step step = step_of(preset::StepKind::jitter);
  step.seed = command.seed;
  step.force_N = 20 * now_.preset.jitter.field_N_per_mm * now_.scene->footprint.spacing;
  const auto joints = Eigen::Index(now_.scene->footprint.joints.size());
  const Eigen::Matrix3Xd before = session_->nodes().leftCols(joints);
  const bool snapped = now_.snapped;
  TRY_DO(do_step(std::move(step), watch));
  // the shell is in the same state again, so the events on the path are not reported
  const Eigen::Matrix3Xd moved = session_->nodes().leftCols(joints) - before;
  if (moved.colwise().norm().maxCoeff() > same_shape * now_.scene->length_scale_mm) return {};
  view_.message = "perturbed, and in the same state again";
  view_.event.clear();
  now_.snapped = snapped;
  return {};
}

}  // namespace gridshell::window
