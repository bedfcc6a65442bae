#include "app/window/edit_session.h"

#include <algorithm>
#include <utility>

#include "engine/core/try.h"

namespace gridshell::window {

namespace {

/// Whether positions are equal bit for bit, on the same mesh.
bool same_nodes(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cols() == b.cols() && a == b;
}

}  // namespace

LevelPlan drag_plan(const Scene& scene, const LevelPlan& now) {
  // joints times edges per segment: smaller shells are solved on all meshes within a frame of the
  // window, and a run then reaches the same state
  constexpr std::size_t small = 4800;
  if (scene.footprint.joints.size() * std::size_t(now.edges_per_segment.back()) <= small)
    return now;
  const int coarsest = simulate::initial_levels(scene).edges_per_segment.front();
  return {{std::max(coarsest, scene.base_edges)}, false};
}

void EditSession::execute(const Command& command, const Watch& watch) {
  remembered_ = false;
  try {
    run_command(command, watch);
  } catch (const std::exception& error) {
    recover(command, error);
  }
  pending_redo_.clear();
}

void EditSession::run_command(const Command& command, const Watch& watch) {
  const double begin = seconds_now();
  // the end of a drag leaves the message about its events
  const bool settles = is_any<RefineAfterDrag>(command.edit);
  const bool swaps_state = is_any<Undo, Redo, AcceptDesign, DiscardDesign>(command.edit);
  if (!settles) {
    view_.error.clear();
    view_.offer.reset();
    view_.event.clear();
    // so do further commands of the drag
    if (command.drag == 0 || command.drag != this_drag_) view_.message.clear();
  }
  if (!settles) view_.push_path.clear();
  this_drag_ = command.drag;
  passing_ = command.passing;
  remembered_ = !swaps_state && !settles && remember(command);
  if (!settles && !is_any<Undo, Redo, DiscardDesign>(command.edit)) accept_design();
  if (session_ && command.passing && session_->shell().levels() > 1) coarsen(watch);
  const bool moves =
      is_any<Move, Push, Release, DragEdge, ResetEdgePoint, Rest, Jitter, Recall>(command.edit);
  const Result<void> done =
      moves && !session_
          ? invalid("there is no shell yet")
          : std::visit([&](const auto& edit) { return act(edit, watch); }, command.edit);
  if (!done)
    view_.error = done.error().fault == Fault::cancelled ? "stopped" : done.error().message;
  // a command that moved nothing is no step to undo
  const bool refused = !done && done.error().fault == Fault::bad_input;
  if (!done && remembered_ && undo_.back().state.scene == now_.scene &&
      (refused || same_nodes(undo_.back().checkpoint.state.x, session_->nodes()))) {
    // the meshes, too, are those of before
    if (refused) session_->restore(undo_.back().checkpoint);
    take_back_step();
  }
  // refine() finds out whether these meshes still meet the tolerance
  if (!swaps_state) now_.refined = false;
  only_coarse_mesh_ = false;
  update_view();
  if (!settles) view_.seconds = seconds_now() - begin;
}

void EditSession::refine(const Watch& watch) {
  if (!session_ || now_.refined) return;
  try {
    const Checkpoint before = session_->save();
    try {
      refine_meshes(watch);
    } catch (const std::exception&) {
      session_->restore(before);
      throw;
    }
  } catch (const std::exception& error) {
    view_.error = error_text(error);
    now_.refined = only_coarse_mesh_ = true;
  }
}

void EditSession::refine_meshes(const Watch& watch) {
  const double begin = seconds_now();
  // whether nothing was done to the shell since it was formed
  const bool untouched = now_.first && same_nodes(now_.first->nodes, view_.frame.nodes);
  const LevelPlan plan = simulate::initial_levels(*now_.scene);
  const std::vector<int>& now = session_->shell().plan().edges_per_segment;
  const bool fine_enough = now_.scene->edges_per_segment == 0 && now.size() > 1 &&
                           now.back() >= plan.edges_per_segment.back();
  if (!fine_enough && now != plan.edges_per_segment) {
    const auto fine = session_->remesh(plan, watch);
    if (watch.cancelled()) return;
    if (!fine || fine->end != Outcome::reached) {
      view_.error = "finer meshes do not have this state";
      now_.refined = only_coarse_mesh_ = true;
      return update_view();
    }
  }
  if (now_.scene->edges_per_segment == 0)
    (void)session_->refine(now_.scene->tolerance * now_.scene->length_scale_mm, watch);
  now_.refined = !watch.cancelled();
  update_view();
  if (untouched) view_.first = now_.first = std::make_shared<const record::Frame>(view_.frame);
  view_.seconds = seconds_now() - begin;
  if (now_.refined) note_state();
}

void EditSession::coarsen(const Watch& watch) {
  // if the coarse mesh does not have this state, the drag continues on the finer ones
  (void)session_->remesh(drag_plan(*now_.scene, session_->shell().plan()), watch);
}

/// Stores the events of a step as the message. Errors: cancelled; no_equilibrium if it ended early.
Result<void> EditSession::note_events(const Report& report) {
  const std::string text = text_of_events(report.events);
  if (!text.empty()) view_.message = text;
  for (const Event& event : report.events) now_.snapped = now_.snapped || event.to.has_value();
  if (!report.events.empty() && report.events.back().to && report.certificate.stable())
    view_.message += ", in another equilibrium";
  if (!text.empty()) view_.event = view_.message;
  if (report.end == Outcome::cancelled) return stopped();
  if (report.end == Outcome::reached) return {};
  return fail(Fault::no_equilibrium, words_of(report.end).what);
}

Result<void> EditSession::form(const preset::Preset& preset, const Watch& watch) {
  TRY(made, shared_scene_of(preset));
  const std::shared_ptr<const Scene>& scene = *made;
  if (scene->rod_model == RodModel::net)
    return invalid("the model 'net' is geometry alone: there is nothing to push");
  // on the meshes of a run, so that both reach the same states; while a number is dragged on one
  // mesh, which does not know whether finer ones have its events
  const LevelPlan one{{simulate::initial_levels(*scene).edges_per_segment.back()}, false};
  TRY(path, passing_ ? simulate::follow_actuation(scene, one, false, 1, watch)
                     : simulate::converged_actuation(scene, false, 1, watch));
  path->simulation.shell().allow_any_error();  // of the steps that follow: refine() reduces it
  std::vector<PathMark> marks;
  for (const simulate::PathSegment& segment : path->segments)
    add_marks(marks, marks_of(segment, segment.report.events, -1, progress_at));
  const bool snapped = std::ranges::any_of(
      path->segments, [](const auto& segment) { return !segment.report.events.empty(); });
  set_shell(preset, scene, std::move(path->simulation));
  now_.marks = std::move(marks);
  now_.snapped = snapped;
  now_.first.reset();
  view_.message = view_.event = path->limit_reason;
  if (!preset.step.empty()) refine(watch);  // as a run does before its steps
  for (const preset::Step& step : preset.step) {
    // do_step() compares with the state in the view
    update_view();
    TRY_DO(do_step(step, watch));
  }
  return set_preset_push();
}

/// Replaces the shell by another one without steps.
void EditSession::set_shell(const preset::Preset& preset, std::shared_ptr<const Scene> scene,
                            Simulation session) {
  const auto first = now_.first;
  now_ = {};
  now_.preset = preset;
  now_.preset.step.clear();
  now_.first = first;
  now_.scene = std::move(scene);
  session_ = std::move(session);
  steps_drag_ = 0;
  view_.layout.reset();
}

/// Stores the push of [indentation], which starts at the current state.
Result<void> EditSession::set_preset_push() {
  if (!now_.preset.indentation.requested()) return {};
  TRY(push, simulate::push_of(now_.preset.indentation, *now_.scene, session_->shell()));
  now_.push = {push->joint, session_->nodes().col(push->joint), push->displacement};
  return {};
}

Result<void> EditSession::act(const Open& command, const Watch& watch) {
  const auto before = now_.scene;
  auto found = std::exchange(found_, {});
  auto last = std::exchange(last_found_, {});
  auto seen = std::exchange(view_.found, {});
  auto formed = form(command.preset, watch);
  // the shell from before is still there, and so are its states
  if (!formed && now_.scene == before) {
    found_ = std::move(found);
    last_found_ = std::move(last);
    view_.found = std::move(seen);
  }
  return formed;
}

Result<void> EditSession::act(const Change& command, const Watch& watch) {
  if (!session_) return form(command.preset, watch);
  auto changed = change_preset(command.preset, watch);
  if (!changed && changed.error().fault == Fault::bad_input)
    view_.offer = nearest_that_works(view_.preset, command.preset);
  if (changed && !command.remark.empty())
    view_.message += (view_.message.empty() ? "" : "; ") + command.remark;
  return changed;
}

Result<void> EditSession::change_preset(const preset::Preset& preset, const Watch& watch) {
  const ChangeKind kind = kind_of_change(view_.preset, preset);
  if (kind == ChangeKind::none) return {};
  TRY_DO(check_preset(preset));
  switch (kind) {
    case ChangeKind::none:
      break;
    case ChangeKind::looks:
      now_.preset = with_boundary_end(preset);
      return {};
    case ChangeKind::accuracy: {
      auto scene = std::make_shared<Scene>(*now_.scene);
      scene->tolerance = preset.accuracy.tolerance;
      scene->edges_per_segment = preset.accuracy.edges_per_segment;
      scene->memory_GB = preset.accuracy.memory_GB;
      now_.scene = std::move(scene);
      now_.preset.accuracy = preset.accuracy;
      now_.refined = false;
      return {};
    }
    case ChangeKind::boundary:
      return act(Move{now_.scene->progress_of_radius(preset.actuated_radius_mm())}, watch);
    case ChangeKind::rods:
      return change_rods(preset, watch);
    case ChangeKind::shape:
      return rebuild_shell(preset, watch);
  }
  return {};
}

/// Forms a shell of another preset; the steps that were done are not repeated.
Result<void> EditSession::rebuild_shell(const preset::Preset& preset, const Watch& watch) {
  const bool untouched = now_.steps.empty() && session_->constraint_origins.empty();
  return form(preset, watch).map([&] {
    if (untouched) return;
    if (!view_.message.empty()) view_.message += "; ";
    view_.message += "formed again, without the steps that were done: Undo brings them back";
  });
}

Result<void> EditSession::change_rods(const preset::Preset& preset, const Watch& watch) {
  preset::Preset changed = with_boundary_end(preset);
  TRY(scene, shared_scene_of(changed));
  if ((*scene)->rod_model != now_.scene->rod_model) return rebuild_shell(preset, watch);
  const Checkpoint before = session_->save();
  const bool within_limits = !session_->exceeded_limit();
  TRY(report, session_->set_rods((*scene)->rods, watch));
  TRY_DO(note_events(*report));
  // diameters and strengths are those of the scene that a session has
  const Checkpoint state = session_->save();
  TRY(session, Simulation::open(*scene, state.shell->plan()));
  session->restore(state);
  if (const auto limit = session->exceeded_limit(); limit && within_limits) {
    session_->restore(before);
    return invalid("these rods would be past a limit in this state ({}): move the shell back first",
                   text_of_events({*limit}));
  }
  session_ = std::move(*session);
  now_.scene = std::move(*scene);
  now_.preset = std::move(changed);
  now_.rods_changed_late = !now_.steps.empty();
  view_.layout.reset();
  return {};
}

/// A preset with the end of the boundary's motion that the scene has; in the view it is the current
/// position.
preset::Preset EditSession::with_boundary_end(preset::Preset preset) const {
  preset.actuation.radius_mm = now_.preset.actuation.radius_mm;
  preset.actuation.ratio = now_.preset.actuation.ratio;
  return preset;
}

}  // namespace gridshell::window
