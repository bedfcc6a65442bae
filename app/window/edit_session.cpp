#include "app/window/edit_session.h"

#include <algorithm>
#include <utility>

#include "engine/core/packing.h"
#include "engine/core/try.h"

namespace gridshell::window {

std::optional<ScratchFile::Place> ScratchFile::put(std::string_view bytes) {
  if (!file_) file_.reset(std::tmpfile());
  if (!file_ || ::fseeko(file_.get(), end_, SEEK_SET) != 0 ||
      std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size() ||
      std::fflush(file_.get()) != 0)
    return std::nullopt;
  return Place{std::exchange(end_, end_ + std::int64_t(bytes.size())), bytes.size()};
}

std::string ScratchFile::take(const Place& place) const {
  std::string bytes(place.size, 0);
  const bool read = file_ && ::fseeko(file_.get(), place.at, SEEK_SET) == 0 &&
                    std::fread(bytes.data(), 1, place.size, file_.get()) == place.size;
  return read ? bytes : std::string();
}

namespace {

constexpr std::int64_t most_bytes_aside = std::int64_t(8) << 30;

/// Calls visit(array) for each of a checkpoint's arrays of numbers.
template <class Kept, class Visit>
void each_array(Kept& kept, const Visit& visit) {
  visit(kept.state.x), visit(kept.state.velocity.x), visit(kept.state.velocity.force);
  for (auto& level : kept.state.levels)
    visit(level.x), visit(level.force), visit(level.director), visit(level.reference_twist);
  for (auto& motion : kept.motions) visit(motion.begin), visit(motion.change);
}

std::int64_t bytes_of(const Checkpoint& kept) {
  std::int64_t doubles = 0;
  each_array(kept, [&](const auto& array) { doubles += array.size(); });
  return doubles * std::int64_t(sizeof(double));
}

/// To the bit, on the same mesh.
bool same_nodes(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cols() == b.cols() && a == b;
}

}  // namespace

LevelPlan coarse_plan(const Scene& scene) {
  return {{simulate::initial_levels(scene).edges_per_segment.front()}, false};
}

void EditSession::execute(const Command& command, const Watch& watch) {
  const double begin = seconds_now();
  // what a drag came past stays said at its end
  const bool settles = is_any<RefineAfterDrag>(command.edit);
  const bool travels = is_any<Undo, Redo, AcceptDesign, DiscardDesign>(command.edit);
  if (!settles) {
    view_.error.clear();
    view_.event.clear();
    // nor is it cleared by what the drag does next
    if (command.drag == 0 || command.drag != this_drag_) view_.message.clear();
  }
  if (!settles) view_.way.clear();
  this_drag_ = command.drag;
  const bool remembered = !travels && !settles && remember(command);
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
  // what moved nothing is no step
  const bool refused = !done && done.error().fault == Fault::bad_input;
  if (!done && remembered && undo_.back().state.scene == now_.scene &&
      (refused || same_nodes(undo_.back().checkpoint.state.x, session_->nodes()))) {
    // on the meshes of before, too
    if (refused) session_->restore(undo_.back().checkpoint);
    undo_.pop_back();
    drag_ = 0;
  }
  // whether these meshes still meet the tolerance is for refine() to find out
  if (!travels) now_.refined = false;
  only_coarse_mesh_ = false;
  update_view();
  if (!settles) view_.seconds = seconds_now() - begin;
}

void EditSession::refine(const Watch& watch) {
  if (!session_ || now_.refined) return;
  const double begin = seconds_now();
  // a shell that nothing happened to since it was formed
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
    session_->refine(now_.scene->tolerance * now_.scene->length_scale_mm, watch);
  now_.refined = !watch.cancelled();
  update_view();
  if (untouched) view_.first = now_.first = std::make_shared<const record::Frame>(view_.frame);
  view_.seconds = seconds_now() - begin;
  if (now_.refined) note_state();
}

void EditSession::coarsen(const Watch& watch) {
  // where the coarse mesh does not have this state, the drag goes on on the finer ones
  session_->remesh(coarse_plan(*now_.scene), watch);
}

// ---- steps ----

/// Keeps the state before a command, but for one of the drag that the last step began.
bool EditSession::remember(const Command& command) {
  if (!session_ || (command.drag != 0 && command.drag == drag_)) return false;
  drag_ = command.drag;
  redo_.clear();
  undo_.push_back({now_, session_->save(), is_any<Design>(command.edit)});
  keep_within_memory(undo_);
  return true;
}

/// Older steps go to a file; where that has no room, they are forgotten.
void EditSession::keep_within_memory(std::deque<UndoStep>& steps) {
  clear_scratch();
  std::int64_t bytes = 0;
  std::size_t kept = 0;
  while (kept < steps.size() && bytes <= most_bytes_)
    bytes += bytes_of(steps[steps.size() - 1 - kept++].checkpoint);
  // those before are aside already but for the last few
  for (std::size_t k = steps.size() - kept; k-- > 0 && !steps[k].saved;)
    if (!save_to_scratch(steps[k])) {
      steps.erase(steps.begin(), steps.begin() + std::ptrdiff_t(k) + 1);
      return;
    }
}

/// What nobody can go back to makes room.
void EditSession::clear_scratch() {
  const auto saved = [](const UndoStep& step) { return step.saved.has_value(); };
  if (std::ranges::none_of(undo_, saved) && std::ranges::none_of(redo_, saved))
    scratch_ = ScratchFile();
}

bool EditSession::save_to_scratch(UndoStep& step) {
  if (scratch_.bytes() > most_bytes_aside) return false;
  ByteWriter out;
  each_array(step.checkpoint, [&](const auto& array) { out.matrix(array); });
  step.saved = scratch_.put(out.bytes());
  if (step.saved) each_array(step.checkpoint, []<class Array>(Array& array) { array = Array(); });
  return step.saved.has_value();
}

bool EditSession::load_from_scratch(UndoStep& step) const {
  if (!step.saved) return true;
  const std::string bytes = scratch_.take(*step.saved);
  step.saved.reset();
  ByteReader in(bytes);
  each_array(step.checkpoint, [&](auto& array) { in.matrix(array); });
  return in.at_end();
}

Result<void> EditSession::restore(const UndoStep& step) {
  if (step.state.scene != now_.scene) {
    TRY(session, Simulation::open(step.state.scene, step.checkpoint.shell->plan()));
    session_ = std::move(*session);
  }
  session_->restore(step.checkpoint);
  now_ = step.state;
  view_.layout.reset();
  steps_drag_ = 0;
  return {};
}

Result<void> EditSession::travel(std::deque<UndoStep>& from, std::deque<UndoStep>& to,
                                 const char* none) {
  if (from.empty()) return invalid(none);
  UndoStep back = std::move(from.back());
  from.pop_back();
  if (!load_from_scratch(back))
    return fail(Fault::io, "the state was put aside into a file that cannot be read");
  // of what is done again it is known what it was
  to.push_back({now_, session_->save(), back.before_design});
  keep_within_memory(to);
  drag_ = 0;
  return restore(back);
}

Result<void> EditSession::act(const Undo& command, const Watch&) {
  auto back = travel(undo_, redo_, "there is nothing to undo");
  while (command.all && back && !undo_.empty()) back = travel(undo_, redo_, "");
  return back;
}

Result<void> EditSession::act(const Redo&, const Watch&) {
  return travel(redo_, undo_, "there is nothing to do again");
}

// ---- edits ----

/// Notes what a step came past; an end before its end is the error.
Result<void> EditSession::note_events(const Report& report) {
  const std::string text = text_of_events(report.events);
  if (!text.empty()) view_.message = text;
  for (const Event& event : report.events) now_.snapped = now_.snapped || event.to.has_value();
  if (!report.events.empty() && report.events.back().to && report.certificate.stable())
    view_.message += ", at rest in another state";
  if (!text.empty()) view_.event = view_.message;
  if (report.end == Outcome::cancelled) return stopped();
  if (report.end == Outcome::reached) return {};
  return fail(Fault::no_equilibrium, words_of(report.end).what);
}

Result<void> EditSession::form(const preset::Preset& preset, const Watch& watch) {
  TRY(made, shared_scene_of(preset));
  const std::shared_ptr<const Scene>& scene = *made;
  if (scene->rung == RodModel::net)
    return invalid("the rung 'net' is geometry alone: there is nothing to push");
  // on the mesh that a run follows, so that both come to the same states
  const LevelPlan plan{{simulate::initial_levels(*scene).edges_per_segment.back()}, false};
  TRY(course, simulate::follow_actuation(scene, plan, false, 1, watch));
  std::vector<PathMark> marks;
  for (const simulate::PathSegment& segment : course->segments)
    add_marks(marks, marks_of(segment, segment.report.events, -1, progress_at));
  const bool snapped = std::ranges::any_of(
      course->segments, [](const auto& segment) { return !segment.report.events.empty(); });
  set_shell(preset, scene, std::move(course->simulation));
  now_.marks = std::move(marks);
  now_.snapped = snapped;
  now_.first.reset();
  view_.message = view_.event = course->limit_reason;
  for (const preset::Step& step : preset.step) {
    // what stands before a step is what it is seen against
    update_view();
    TRY_DO(do_step(step, watch));
  }
  return set_preset_push();
}

/// Another shell, to which nothing was done.
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

/// What the preset itself pushes, from where the shell stands.
Result<void> EditSession::set_preset_push() {
  if (!now_.preset.indentation.wanted()) return {};
  TRY(push, simulate::push_of(now_.preset.indentation, *now_.scene, session_->shell().finest(),
                              session_->nodes()));
  now_.push = {push->joint, session_->nodes().col(push->joint), push->displacement};
  return {};
}

Result<void> EditSession::act(const Open& command, const Watch& watch) {
  found_.clear();
  at_rest_.reset();
  view_.found.reset();
  return form(command.preset, watch);
}

Result<void> EditSession::act(const Change& command, const Watch& watch) {
  if (!session_) return form(command.preset, watch);
  const ChangeKind kind = kind_of_change(view_.preset, command.preset);
  if (kind == ChangeKind::none) return {};
  TRY_DO(check_preset(command.preset));
  switch (kind) {
    case ChangeKind::none:
      break;
    case ChangeKind::looks:
      take_over_keys(command.preset);
      return {};
    case ChangeKind::accuracy: {
      auto scene = std::make_shared<Scene>(*now_.scene);
      scene->tolerance = command.preset.accuracy.tolerance;
      scene->edges_per_segment = command.preset.accuracy.edges_per_segment;
      scene->memory_GB = command.preset.accuracy.memory_GB;
      now_.scene = std::move(scene);
      now_.preset.accuracy = command.preset.accuracy;
      now_.refined = false;
      return {};
    }
    case ChangeKind::boundary:
      return act(Move{now_.scene->progress_of_radius(command.preset.actuated_radius_mm())}, watch);
    case ChangeKind::rods:
      return change_rods(command.preset, watch);
    case ChangeKind::shape:
      return rebuild_shell(command.preset, watch);
  }
  return {};
}

/// A shell of another preset, to which nothing that was done before is done again.
Result<void> EditSession::rebuild_shell(const preset::Preset& preset, const Watch& watch) {
  const bool untouched = now_.steps.empty() && session_->grip_origins.empty();
  return form(preset, watch).map([&] {
    if (untouched) return;
    if (!view_.message.empty()) view_.message += "; ";
    view_.message += "formed anew, without what was done by hand: Undo brings that back";
  });
}

Result<void> EditSession::change_rods(const preset::Preset& preset, const Watch& watch) {
  TRY(scene, scene_of(preset));
  if (scene->rung != now_.scene->rung) return rebuild_shell(preset, watch);
  TRY(report, session_->set_rods(scene->rods, watch));
  TRY_DO(note_events(*report));
  take_over_keys(preset);
  now_.rods_changed_late = !now_.steps.empty();
  return {};
}

/// All but where the boundary's motion ends, which the scene has.
void EditSession::take_over_keys(const preset::Preset& preset) {
  const double radius = now_.preset.actuation.radius_mm, ratio = now_.preset.actuation.ratio;
  now_.preset = preset;
  now_.preset.actuation.radius_mm = radius, now_.preset.actuation.ratio = ratio;
}

}  // namespace gridshell::window
