#include "app/window/edit_session.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "app/window/command.h"
#include "engine/core/system_info.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"

namespace gridshell::window {

bool ScratchFile::write(const double* numbers, std::size_t count) {
  if (count == 0) return true;
  if (!file_) file_.reset(std::tmpfile());
  const bool written = file_ && ::fseeko(file_.get(), end_, SEEK_SET) == 0 &&
                       std::fwrite(numbers, sizeof(double), count, file_.get()) == count &&
                       std::fflush(file_.get()) == 0;
  if (written) end_ += std::int64_t(count * sizeof(double));
  return written;
}

bool ScratchFile::read(std::int64_t at, double* numbers, std::size_t count) const {
  if (count == 0) return true;
  return file_ && ::fseeko(file_.get(), at, SEEK_SET) == 0 &&
         std::fread(numbers, sizeof(double), count, file_.get()) == count;
}

namespace {

constexpr std::int64_t most_bytes_aside = std::int64_t(8) << 30;

/// Calls visit(array) for each of a checkpoint's arrays of numbers, as long as it returns true.
template <class Kept, class Visit>
bool each_array(Kept& kept, const Visit& visit) {
  if (!visit(kept.state.x)) return false;
  for (auto& level : kept.state.levels)
    if (!visit(level.x) || !visit(level.force) || !visit(level.director) ||
        !visit(level.reference_twist))
      return false;
  for (auto& motion : kept.motions)
    if (!visit(motion.begin) || !visit(motion.change)) return false;
  return true;
}

std::int64_t bytes_of(const Checkpoint& kept) {
  std::int64_t doubles = 0;
  each_array(kept, [&](const auto& array) {
    doubles += array.size();
    return true;
  });
  return doubles * std::int64_t(sizeof(double));
}

/// To the bit, on the same mesh.
bool same_nodes(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cols() == b.cols() && a == b;
}

/// "the path lost its stability; came to rest in another state" of what a step came past.
std::string told_of(const std::vector<Event>& events) {
  std::string told;
  for (const Event& event : events) {
    if (!told.empty()) told += "; ";
    switch (event.kind) {
      case Event::Kind::stability_lost:
        told += event.to ? "stability lost: snapped to another state" : "stability lost";
        break;
      case Event::Kind::turned_back:
        told += event.to ? "the path turned back: snapped to another state" : "path turned back";
        break;
      case Event::Kind::locked:
        told += "the rods are at their length";
        break;
    }
  }
  return told;
}

}  // namespace

LevelPlan coarse_plan(const Scene& scene) {
  return {{simulate::initial_levels(scene).edges_per_segment.front()}, false};
}

void EditSession::execute(const Command& command, const Watch& watch) {
  const double begin = seconds_now();
  // what a drag came past stays said when the hand lets go
  const bool settles = std::holds_alternative<RefineAfterDrag>(command.edit);
  if (!settles) {
    shell_view_.trouble.clear();
    shell_view_.told.clear();
  }
  now_stroke_ = command.stroke;
  const bool remembered = remember(command);
  accept_design(command);
  if (session_ && command.passing && session_->shell().levels() > 1) coarsen(watch);
  const auto done = std::visit([&](const auto& edit) { return act(edit, watch); }, command.edit);
  if (!done)
    shell_view_.trouble = done.error().fault == Fault::cancelled ? "stopped" : done.error().message;
  // what moved nothing is no step
  const bool refused = !done && done.error().fault == Fault::bad_input;
  if (!done && remembered && undo_.back().scene == scene_ &&
      (refused || same_nodes(undo_.back().checkpoint.state.x, session_->nodes()))) {
    // on the meshes of before, too
    if (refused) session_->restore(undo_.back().checkpoint);
    undo_.pop_back();
    stroke_ = 0;
  }
  // whether these meshes still meet the tolerance is for refine() to find out
  const bool travelled = std::holds_alternative<Undo>(command.edit) ||
                         std::holds_alternative<Redo>(command.edit) ||
                         std::holds_alternative<AcceptDesign>(command.edit) ||
                         std::holds_alternative<DiscardDesign>(command.edit);
  if (!travelled) refined_ = false;
  only_coarse_mesh_ = false;
  look();
  if (!settles) shell_view_.seconds = seconds_now() - begin;
}

void EditSession::refine(const Watch& watch) {
  if (!session_ || refined_) return;
  const double begin = seconds_now();
  // a shell that nothing happened to since it was formed
  const bool untouched = shell_view_.first &&
                         shell_view_.first->nodes.cols() == shell_view_.frame.nodes.cols() &&
                         shell_view_.first->nodes == shell_view_.frame.nodes;
  const LevelPlan plan = simulate::initial_levels(*scene_);
  const std::vector<int>& now = session_->shell().plan().edges_per_segment;
  const bool fine_enough = scene_->edges_per_segment == 0 && now.size() > 1 &&
                           now.back() >= plan.edges_per_segment.back();
  if (!fine_enough && now != plan.edges_per_segment) {
    const auto fine = session_->remesh(plan, watch);
    if (watch.cancelled()) return;
    if (!fine || fine->end != Outcome::reached) {
      shell_view_.trouble = "finer meshes do not have this state";
      refined_ = only_coarse_mesh_ = true;
      return look();
    }
  }
  if (scene_->edges_per_segment == 0)
    session_->refine(scene_->tolerance * scene_->length_scale_mm, watch);
  refined_ = !watch.cancelled();
  look();
  if (untouched) shell_view_.first = std::make_shared<const record::Frame>(shell_view_.frame);
  shell_view_.seconds = seconds_now() - begin;
}

void EditSession::coarsen(const Watch& watch) {
  // where the coarse mesh does not have this state, the drag goes on on the finer ones
  session_->remesh(coarse_plan(*scene_), watch);
}

// ---- steps ----

EditSession::Step EditSession::step() const {
  return {preset_,           scene_,  session_->save(), shell_view_.push,
          shell_view_.first, steps_,  refined_,         changed_late_,
          snapped_,          design_, target_};
}

/// Keeps the state before a command, but for one of the stroke that the last step began.
bool EditSession::remember(const Command& command) {
  const bool travels = std::holds_alternative<Undo>(command.edit) ||
                       std::holds_alternative<Redo>(command.edit) ||
                       std::holds_alternative<AcceptDesign>(command.edit) ||
                       std::holds_alternative<DiscardDesign>(command.edit) ||
                       std::holds_alternative<RefineAfterDrag>(command.edit);
  if (travels || !session_ || (command.stroke != 0 && command.stroke == stroke_)) return false;
  stroke_ = command.stroke;
  redo_.clear();
  undo_.push_back(step());
  undo_.back().before_design = std::holds_alternative<Design>(command.edit);
  keep_within_memory(undo_);
  return true;
}

/// Older steps go to a file; where that has no room, they are forgotten.
void EditSession::keep_within_memory(std::deque<Step>& steps) {
  clear_scratch();
  std::int64_t bytes = 0;
  std::size_t kept = 0;
  while (kept < steps.size() && bytes <= most_bytes_)
    bytes += bytes_of(steps[steps.size() - 1 - kept++].checkpoint);
  // those before are aside already but for the last few
  for (std::size_t k = steps.size() - kept; k-- > 0 && steps[k].aside.empty();)
    if (!save_to_scratch(steps[k])) {
      steps.erase(steps.begin(), steps.begin() + std::ptrdiff_t(k) + 1);
      return;
    }
}

/// What nobody can go back to makes room.
void EditSession::clear_scratch() {
  const auto aside = [](const Step& step) { return !step.aside.empty(); };
  if (std::ranges::none_of(undo_, aside) && std::ranges::none_of(redo_, aside))
    aside_ = ScratchFile();
}

bool EditSession::save_to_scratch(Step& step) {
  if (aside_.bytes() > most_bytes_aside) return false;
  return each_array(step.checkpoint,
                    [&](auto& array) { return aside_.put(array, step.aside.emplace_back()); });
}

bool EditSession::load_from_scratch(Step& step) const {
  auto at = step.aside.begin();
  const bool back = at == step.aside.end() || each_array(step.checkpoint, [&](auto& array) {
                      return aside_.take(*at++, array);
                    });
  step.aside.clear();
  return back;
}

Result<void> EditSession::stand(const Step& step) {
  if (step.scene != scene_) {
    TRY(session, Simulation::open(step.scene, step.checkpoint.plan));
    session_ = std::move(*session);
  }
  session_->restore(step.checkpoint);
  preset_ = step.preset;
  scene_ = step.scene;
  shell_view_.push = step.push;
  shell_view_.first = step.first;
  shell_view_.layout.reset();
  steps_ = step.steps;
  kept_stroke_ = 0;
  refined_ = step.refined;
  changed_late_ = step.rods_changed_late;
  snapped_ = step.snapped;
  design_ = step.design;
  target_ = step.target;
  return {};
}

Result<void> EditSession::travel(std::deque<Step>& from, std::deque<Step>& to, const char* none) {
  if (from.empty()) return fail(Fault::bad_input, none);
  Step back = std::move(from.back());
  from.pop_back();
  if (!load_from_scratch(back))
    return fail(Fault::io, "the state was put aside into a file that cannot be read");
  to.push_back(step());
  // of what is done again it is known what it was
  to.back().before_design = back.before_design;
  keep_within_memory(to);
  stroke_ = 0;
  return stand(back);
}

Result<void> EditSession::act(const Undo& command, const Watch&) {
  auto back = travel(undo_, redo_, "there is nothing to undo");
  while (command.all && back && !undo_.empty()) back = travel(undo_, redo_, "");
  return back;
}

Result<void> EditSession::act(const Redo&, const Watch&) {
  return travel(redo_, undo_, "there is nothing to do again");
}

// ---- deeds ----

/// Notes what a step came past; an end before its end is the error.
Result<void> EditSession::ended(const Report& report) {
  shell_view_.told = told_of(report.events);
  for (const Event& event : report.events) snapped_ = snapped_ || event.to.has_value();
  if (report.end == Outcome::cancelled) return stopped();
  if (report.end == Outcome::reached) return {};
  return fail(Fault::no_equilibrium, words_of(report.end).what);
}

Result<void> EditSession::form(const preset::Preset& preset, const Watch& watch) {
  TRY(made, shared_scene_of(preset));
  const std::shared_ptr<const Scene>& scene = *made;
  if (scene->rung == RodModel::net)
    return fail(Fault::bad_input, "the rung 'net' is geometry alone: there is nothing to push");
  TRY(course, simulate::follow_actuation(scene, coarse_plan(*scene), false, 1, watch));
  begin_again(preset, scene, std::move(course->simulation));
  snapped_ = course->has_events();
  design_.reset();
  target_.reset();
  shell_view_.told = course->limit_reason;
  shell_view_.first.reset();
  for (const preset::Step& step : preset.step) {
    // what stands before a step is what it is seen against
    look();
    if (auto done = do_step(step, watch); !done) return done;
  }
  return take_push();
}

/// Another shell, which no hand has touched.
void EditSession::begin_again(const preset::Preset& preset, std::shared_ptr<const Scene> scene,
                              Simulation session) {
  preset_ = preset;
  preset_.step.clear();
  scene_ = std::move(scene);
  session_ = std::move(session);
  steps_.clear();
  kept_stroke_ = 0;
  refined_ = changed_late_ = snapped_ = false;
  shell_view_.push = {};
  shell_view_.layout.reset();
}

/// What the preset itself pushes, from where the shell stands.
Result<void> EditSession::take_push() {
  if (!preset_.indentation.wanted()) return {};
  TRY(push, simulate::push_of(preset_.indentation, *scene_, session_->shell().finest(),
                              session_->nodes()));
  shell_view_.push = {push->joint, session_->nodes().col(push->joint), push->displacement};
  return {};
}

Result<void> EditSession::act(const Open& command, const Watch& watch) {
  return form(command.preset, watch);
}

Result<void> EditSession::act(const Change& command, const Watch& watch) {
  if (!session_) return form(command.preset, watch);
  const ChangeKind kind = kind_of_change(shell_view_.preset, command.preset);
  if (kind == ChangeKind::none) return {};
  if (auto agrees = check_preset(command.preset); !agrees) return agrees;
  switch (kind) {
    case ChangeKind::none:
      break;
    case ChangeKind::looks:
      take_numbers(command.preset);
      return {};
    case ChangeKind::accuracy: {
      auto scene = std::make_shared<Scene>(*scene_);
      scene->tolerance = command.preset.accuracy.tolerance;
      scene->edges_per_segment = command.preset.accuracy.edges_per_segment;
      scene->memory_GB = command.preset.accuracy.memory_GB;
      scene_ = std::move(scene);
      preset_.accuracy = command.preset.accuracy;
      refined_ = false;
      return {};
    }
    case ChangeKind::boundary:
      return act(Move{scene_->progress_of_radius(command.preset.actuated_radius_mm())}, watch);
    case ChangeKind::rods:
      return change_rods(command.preset, watch);
    case ChangeKind::shape:
      return rebuild_shell(command.preset, watch);
  }
  return {};
}

/// A shell of other numbers, to which nothing that the hand did is done again.
Result<void> EditSession::rebuild_shell(const preset::Preset& preset, const Watch& watch) {
  const bool untouched = steps_.empty() && session_->grip_origins.empty();
  return form(preset, watch).map([&] {
    if (untouched) return;
    if (!shell_view_.told.empty()) shell_view_.told += "; ";
    shell_view_.told += "formed anew, without what was done by hand: Undo brings that back";
  });
}

Result<void> EditSession::change_rods(const preset::Preset& preset, const Watch& watch) {
  TRY(scene, scene_of(preset));
  if (scene->rung != scene_->rung) return rebuild_shell(preset, watch);
  TRY(report, session_->set_rods(scene->rods, watch));
  if (auto done = ended(*report); !done) return done;
  take_numbers(preset);
  changed_late_ = !steps_.empty();
  return {};
}

/// All but where the boundary's motion ends, which the scene has.
void EditSession::take_numbers(const preset::Preset& preset) {
  const double radius = preset_.actuation.radius_mm, ratio = preset_.actuation.ratio;
  preset_ = preset;
  preset_.actuation.radius_mm = radius, preset_.actuation.ratio = ratio;
}

}  // namespace gridshell::window
