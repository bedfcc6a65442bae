// Edits as steps of a preset: done, and kept so that a preset can do them again.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "app/window/command.h"
#include "app/window/edit_session.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"

namespace gridshell::window {
namespace {

/// As a preset takes it: what round-off left of a zero is none.
std::vector<double> xyz_of(const Eigen::Vector3d& vector) {
  std::vector<double> xyz;
  for (const double value : vector) xyz.push_back(std::abs(value) < nearest_mm ? 0 : value);
  return xyz;
}

/// The edge points that lie off the boundary's motion.
preset::Points rows_of(const Eigen::Matrix3Xd& dragged) {
  preset::Points rows;
  for (Eigen::Index k = 0; k < dragged.cols(); ++k)
    if (!dragged.col(k).isZero(0))
      rows.push_back({double(k), dragged(0, k), dragged(1, k), dragged(2, k)});
  return rows;
}

constexpr Eigen::Index most_nodes_marked =
    8000;                                       // of the coarsest mesh: some 30 rods per direction
constexpr double same_shape = 2e-3;             // of the length scale
constexpr double part_mm = 1, most_parts = 12;  // of a long push

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

/// Whether a step continues the one before in its direction, so that its end alone counts.
bool goes_on(const preset::Step& before, const preset::Step& step) {
  if (before.kind != step.kind) return false;
  if (step.kind == preset::StepKind::move)
    return before.edge_points.empty() && step.edge_points.empty();
  return step.kind == preset::StepKind::push && before.joint == step.joint && !step.along.empty() &&
         before.along == step.along;
}

std::string text_of_design(const DesignProgress& course) {
  const double percent = 100 / course.length_scale_mm;
  const DesignPoint &first = course.points.front(), &last = course.points.back();
  std::string message =
      fmt::format("{} after {} iteration{}: largest {:.3f} %, before {:.3f} %",
                  course.stopped ? "stopped" : "designed", course.iterations,
                  course.iterations == 1 ? "" : "s", percent * last.max_mm, percent * first.max_mm);
  if (course.inverse.round_mm > 0 && !course.stopped)
    message += course.rounded_max_mm
                   ? fmt::format(", rounded to {:g} mm {:.3f} %", course.inverse.round_mm,
                                 percent * *course.rounded_max_mm)
                   : fmt::format("; rounded to {:g} mm it is lost", course.inverse.round_mm);
  return message;
}

bool varies_rods(const preset::Inverse& inverse) {
  return std::ranges::find(inverse.vary, preset::Vary::diameters) != inverse.vary.end();
}

DesignPoint point_of(const CertifiedStep& now) {
  DesignPoint point{now.step.iteration,
                    now.step.max_mm,
                    now.step.mean_mm,
                    now.eigenvalue,
                    now.step.largest_move_mm,
                    0,
                    0};
  const Eigen::VectorXd& diameter = now.shell_ends.diameter;
  if (diameter.size() > 0)
    point.thinnest_mm = diameter.minCoeff(), point.thickest_mm = diameter.maxCoeff();
  return point;
}

}  // namespace

/// One step, as a preset would have it done.
Result<void> EditSession::do_step(preset::Step step, const Watch& watch) {
  const bool holds = step.kind == preset::StepKind::push || step.kind == preset::StepKind::hold;
  if (holds)
    if (const auto joint = simulate::joint_of(step, now_.scene->footprint))
      // as it was seen, which the coarse mesh of a drag does not change
      session_->constraint_origins.emplace(*joint,
                                           view_.frame.nodes.cols() > *joint
                                               ? Eigen::Vector3d(view_.frame.nodes.col(*joint))
                                               : Eigen::Vector3d(session_->nodes().col(*joint)));
  // a snap starts from an equilibrium on all meshes, as in a run
  const bool leaps = step.kind == preset::StepKind::jitter || step.kind == preset::StepKind::rest ||
                     step.kind == preset::StepKind::release;
  // if finer meshes do not have it, the snap starts on the coarse one
  if (leaps && session_->shell().levels() == 1)
    (void)session_->remesh(simulate::initial_levels(*now_.scene), watch);
  const bool began_stable = view_.stable();
  const double began_mm = pushed_mm(step);
  simulate::StepPath path;
  TRY(report, simulate::apply_step(*session_, step, watch, looks_between() ? &path : nullptr));
  const std::string event_at = note_path(step, path, began_mm, began_stable, *report);
  add_step(std::move(step), *report);
  const auto done = note_events(*report);
  if (!event_at.empty()) view_.event = view_.message += " at " + event_at;
  // stability that was lost may have been regained
  const auto lost = [](const Event& e) { return e.kind == Event::Kind::stability_lost && !e.to; };
  if (!event_at.empty() && report->end == Outcome::reached && report->certificate.stable() &&
      std::ranges::all_of(report->events, lost))
    view_.event = view_.message = "stable again; on the path " + view_.message;
  return done;
}

/// Notes a step as far as it came.
void EditSession::add_step(preset::Step step, const Report& report) {
  if (report.end != Outcome::reached) {
    if (step.kind != preset::StepKind::move && step.kind != preset::StepKind::push) return;
    step.progress = session_->boundary.progress;
    if (step.kind == preset::StepKind::push)
      if (const auto joint = simulate::joint_of(step, now_.scene->footprint))
        step.to_mm = xyz_of(session_->nodes().col(*joint));
  }
  if (step.kind == preset::StepKind::move) step.edge_points = rows_of(session_->boundary.dragged);
  const bool eventful = !report.events.empty() || !view_.event.empty();
  const bool same = this_drag_ != 0 && this_drag_ == steps_drag_ && !now_.steps.empty() &&
                    !eventful && !last_eventful_ && goes_on(*now_.steps.back(), step);
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
  return move_boundary(std::max(command.progress, view_.least_progress), session_->boundary.dragged,
                       watch);
}

Result<void> EditSession::act(const DragEdge& command, const Watch& watch) {
  Eigen::Matrix3Xd dragged = session_->boundary.dragged;
  const Eigen::Index k = command.edge_point;
  if (k < 0 || k >= dragged.cols()) return invalid("no such edge point");
  const BoundaryMotion& motion = now_.scene->motion;
  const double progress = session_->boundary.progress;
  dragged.col(k) = command.to - motion.begin.col(k) - progress * (motion.end - motion.begin).col(k);
  if ((dragged - session_->boundary.dragged).norm() < nearest_mm) return {};
  return move_boundary(progress, dragged, watch);
}

Result<void> EditSession::act(const ResetEdgePoint& command, const Watch& watch) {
  Eigen::Matrix3Xd dragged = session_->boundary.dragged;
  if (command.edge_point < 0)
    dragged.setZero();
  else if (command.edge_point < dragged.cols())
    dragged.col(command.edge_point).setZero();
  if (dragged == session_->boundary.dragged) return invalid("no such edge point was dragged");
  return move_boundary(session_->boundary.progress, dragged, watch);
}

Result<void> EditSession::act(const Push& command, const Watch& watch) {
  const auto& joints = now_.scene->footprint.joints;
  if (command.joint < 0 || command.joint >= int(joints.size())) return invalid("no such joint");
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
  // a long displacement that was typed shows its equilibria as a dragged one does
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

/// Where one equilibrium takes long already, what lies between is not looked at.
bool EditSession::looks_between() const {
  return session_->shell().mesh(0).rod_nodes() < most_nodes_marked;
}

Result<void> EditSession::act(const Release& command, const Watch& watch) {
  if (session_->holds().empty()) return invalid("no joint is fixed");
  std::vector<int> joints{command.joint};
  if (command.joint < 0) {
    joints.clear();
    for (const Constraint& hold : session_->holds()) joints.push_back(hold.node);
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
  // the state that a perturbed shell reaches depends on round-off: on the meshes of a run both
  // reach the same one
  refine(watch);
  preset::Step step = step_of(preset::StepKind::jitter);
  step.seed = command.seed;
  step.force_N = 20 * now_.preset.jitter.field_N_per_mm * now_.scene->footprint.spacing;
  const auto joints = Eigen::Index(now_.scene->footprint.joints.size());
  const Eigen::Matrix3Xd before = session_->nodes().leftCols(joints);
  const bool snapped = now_.snapped;
  TRY_DO(do_step(std::move(step), watch));
  // its events on the path were no path to another state
  const Eigen::Matrix3Xd moved = session_->nodes().leftCols(joints) - before;
  if (moved.colwise().norm().maxCoeff() > same_shape * now_.scene->length_scale_mm) return {};
  view_.message = "perturbed, and in the same state again";
  view_.event.clear();
  now_.snapped = snapped;
  return {};
}

// The shell is designed: its steps are seen as they come, the last certified one stays.

std::string why_not_designed(const ShellView& shell) {
  if (!shell.any()) return "there is no shell yet";
  if (shell.layout->net_nodes.cols() == 0)
    return "this shell was not designed on a net, so there is no surface that it could meet";
  if (const auto needs = key_errors(shell.preset, preset::RuleKind::needs_twist); !needs.empty())
    return "only rods that stretch and bend can be designed: " + needs.front().what;
  if (!shell.held.empty()) return "a joint is fixed: release all joints first";
  if (!shell.steps.empty() || shell.rods_changed_late)
    return "a hand has moved this shell: take that back first (Undo)";
  return "";
}

Result<void> EditSession::act(const Design& command, const Watch& watch) {
  if (const std::string why = why_not_designed(view_); !why.empty()) return invalid(why);
  preset::Preset preset = now_.preset;
  preset.inverse = command.inverse;
  TRY_DO(check_preset(preset));
  TRY(made, shared_scene_of(preset));
  const std::shared_ptr<const Scene>& scene = *made;
  TRY(target, design_target(*scene, preset.inverse.target));

  DesignProgress course;
  course.inverse = preset.inverse;
  course.length_scale_mm = scene->length_scale_mm;
  preset::Preset designed = preset;
  State state;
  const NestedShell& shell = session_->shell();
  const int last = shell.levels() - 1;
  const DesignStart from{scene, shell.mesh(last), shell.model(last),
                         shell.state().levels[std::size_t(last)]};
  // the steps are seen on a mesh of their own
  view_.layout.reset();
  const auto ended =
      design_live(preset, from, command.most_iterations, watch, [&](const CertifiedStep& now) {
        state = now.state;
        designed.ends.table = now.ends;
        if (varies_rods(preset.inverse)) designed.rod_table = now.rods;
        show_design_step(*scene, now, course);
      });
  view_.layout.reset();
  if (!ended) return tl::unexpected<Error>(ended.error());
  course.under_way = false;
  course.stopped = ended->stopped;
  course.iterations = ended->iterations;
  course.rounded_max_mm = ended->rounded_max_mm;
  if (course.points.size() < 2) {
    if (course.stopped) return stopped();
    return fail(Fault::no_equilibrium, "no step brings the shell nearer to its surface");
  }
  TRY_DO(show_designed(designed, state));
  view_.message = text_of_design(course);
  now_.design = std::make_shared<const DesignProgress>(std::move(course));
  now_.target = std::make_shared<DesignTarget>(std::move(*target));
  return {};
}

/// The designed shell, as a preset of it has it, in the state that was designed.
Result<void> EditSession::show_designed(const preset::Preset& designed, const State& state) {
  TRY(made, shared_scene_of(designed));
  const std::shared_ptr<const Scene>& scene = *made;
  TRY(session, Simulation::open(scene, LevelPlan{{designed_on}, false}));
  if (const Report report = session->begin_at(1, state, unwatched); report.end != Outcome::reached)
    return fail(Fault::no_equilibrium,
                std::string("the designed shell is lost: ") + words_of(report.end).what);
  set_shell(designed, scene, std::move(*session));
  return set_preset_push();
}

/// Shows a step while the next one is looked for.
void EditSession::show_design_step(const Scene& scene, const CertifiedStep& now,
                                   DesignProgress& course) {
  ShellView& s = view_;
  course.iterations = now.step.iteration;
  course.points.push_back(point_of(now));
  if (!s.layout) {
    auto layout = simulate::layout_of(scene, now.mesh);
    if (!layout) return;
    layout->flat_nodes = drawn_nodes(now.mesh, scene.flat).leftCols(now.mesh.rod_nodes());
    s.layout = std::make_shared<const record::Layout>(std::move(*layout));
  }
  if (varies_rods(course.inverse)) {
    auto layout = std::make_shared<record::Layout>(*s.layout);
    const Eigen::VectorXd& diameters = now.shell_ends.diameter;
    layout->diameters_mm.assign(diameters.begin(), diameters.end());
    s.layout = std::move(layout);
  }
  const record::Frame before =
      std::exchange(s.frame, simulate::frame_of(scene, now.mesh, now.model, now.state, now.forces));
  s.frame.progress = s.frame.actuation = before.progress;
  s.frame.boundary_radius_mm = before.boundary_radius_mm;
  s.certificate = {now.residual_N, 0, std::numeric_limits<double>::quiet_NaN(), 0};
  s.frame.residual_N = s.certificate.residual_N;
  s.meshes = {designed_on};
  s.refined = false;
  s.symmetry.clear();
  s.soft_mode.resize(3, 0);
  s.axial_N = record::axial_force_of_nodes_N(*s.layout, s.frame);
  s.bending_mJ_m = record::bending_of_nodes_mJ_per_m(*s.layout, s.frame);
  update_deviation(now.distances_mm);
  s.design = std::make_shared<const DesignProgress>(course);
  ++s.equilibria;
  if (listener_) listener_(s);
}

/// A designed shell that something else is done to is kept.
void EditSession::accept_design() {
  if (!now_.design || now_.design->kept) return;
  auto kept = std::make_shared<DesignProgress>(*now_.design);
  kept->kept = true;
  now_.design = std::move(kept);
}

Result<void> EditSession::act(const AcceptDesign&, const Watch&) {
  if (!now_.design) return invalid("nothing was designed that could be kept");
  view_.message = "the designed shell is kept; Ctrl+S saves it with its tables";
  return {};
}

Result<void> EditSession::act(const DiscardDesign&, const Watch&) {
  if (undo_.empty() || !undo_.back().before_design)
    return invalid(now_.design ? "what was done since the design is to be undone first"
                               : "nothing was designed that could be put back");
  return travel(undo_, redo_, "");
}

}  // namespace gridshell::window
