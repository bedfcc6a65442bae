#include "app/window/shell_in_hand.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/window/preset_change.h"
#include "engine/core/clock.h"
#include "engine/experiment/actuation.h"
#include "engine/experiment/indentation.h"

namespace gridshell::window {
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
  return {{experiment::first_plan(scene).edges_per_segment.front()}, false};
}

void ShellInHand::fulfil(const Wish& wish, const Watch& watch) {
  const double begin = seconds_now();
  // what a drag came past stays said when the hand lets go
  const bool settles = std::holds_alternative<Settle>(wish.deed);
  if (!settles) {
    sight_.trouble.clear();
    sight_.told.clear();
  }
  now_stroke_ = wish.stroke;
  const bool remembered = remember(wish);
  accept_design(wish);
  if (session_ && wish.passing && session_->shell().levels() > 1) coarsen(watch);
  const auto done = std::visit([&](const auto& deed) { return act(deed, watch); }, wish.deed);
  if (!done)
    sight_.trouble = done.error().fault == Fault::cancelled ? "stopped" : done.error().message;
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
  const bool travelled =
      std::holds_alternative<Undo>(wish.deed) || std::holds_alternative<Redo>(wish.deed) ||
      std::holds_alternative<KeepDesign>(wish.deed) || std::holds_alternative<PutBack>(wish.deed);
  if (!travelled) refined_ = false;
  coarse_alone_ = false;
  look();
  if (!settles) sight_.seconds = seconds_now() - begin;
}

void ShellInHand::refine(const Watch& watch) {
  if (!session_ || refined_) return;
  const double begin = seconds_now();
  // a shell that nothing happened to since it was formed
  const bool untouched = sight_.first && sight_.first->nodes.cols() == sight_.frame.nodes.cols() &&
                         sight_.first->nodes == sight_.frame.nodes;
  const LevelPlan plan = experiment::first_plan(*scene_);
  const std::vector<int>& now = session_->shell().plan().edges_per_segment;
  const bool fine_enough = scene_->edges_per_segment == 0 && now.size() > 1 &&
                           now.back() >= plan.edges_per_segment.back();
  if (!fine_enough && now != plan.edges_per_segment) {
    const auto fine = session_->remesh(plan, watch);
    if (watch.cancelled()) return;
    if (!fine || fine->end != Outcome::reached) {
      sight_.trouble = "finer meshes do not have this state";
      refined_ = coarse_alone_ = true;
      return look();
    }
  }
  if (scene_->edges_per_segment == 0)
    session_->refine(scene_->tolerance * scene_->length_scale_mm, watch);
  refined_ = !watch.cancelled();
  look();
  if (untouched) sight_.first = std::make_shared<const record::Frame>(sight_.frame);
  sight_.seconds = seconds_now() - begin;
}

void ShellInHand::coarsen(const Watch& watch) {
  // where the coarse mesh does not have this state, the drag goes on on the finer ones
  session_->remesh(coarse_plan(*scene_), watch);
}

// ---- steps ----

ShellInHand::Step ShellInHand::step() const {
  return {preset_, scene_,   session_->save(), boundary_, taken_at_, sight_.push, sight_.first,
          steps_,  refined_, changed_late_,    snapped_,  design_,   target_};
}

/// Keeps the state before a wish, but for one of the stroke that the last step began.
bool ShellInHand::remember(const Wish& wish) {
  const bool travels =
      std::holds_alternative<Undo>(wish.deed) || std::holds_alternative<Redo>(wish.deed) ||
      std::holds_alternative<KeepDesign>(wish.deed) || std::holds_alternative<PutBack>(wish.deed) ||
      std::holds_alternative<Settle>(wish.deed);
  if (travels || !session_ || (wish.stroke != 0 && wish.stroke == stroke_)) return false;
  stroke_ = wish.stroke;
  redo_.clear();
  undo_.push_back(step());
  undo_.back().before_design = std::holds_alternative<Design>(wish.deed);
  keep_within_memory(undo_);
  return true;
}

/// Older steps go to a file; where that has no room, they are forgotten.
void ShellInHand::keep_within_memory(std::deque<Step>& steps) {
  forget_aside();
  std::int64_t bytes = 0;
  std::size_t kept = 0;
  while (kept < steps.size() && bytes <= most_bytes_)
    bytes += bytes_of(steps[steps.size() - 1 - kept++].checkpoint);
  // those before are aside already but for the last few
  for (std::size_t k = steps.size() - kept; k-- > 0 && steps[k].aside.empty();)
    if (!put_aside(steps[k])) {
      steps.erase(steps.begin(), steps.begin() + std::ptrdiff_t(k) + 1);
      return;
    }
}

/// What nobody can go back to makes room.
void ShellInHand::forget_aside() {
  const auto aside = [](const Step& step) { return !step.aside.empty(); };
  if (std::ranges::none_of(undo_, aside) && std::ranges::none_of(redo_, aside))
    aside_ = NumbersFile();
}

bool ShellInHand::put_aside(Step& step) {
  if (aside_.bytes() > most_bytes_aside) return false;
  return each_array(step.checkpoint,
                    [&](auto& array) { return aside_.put(array, step.aside.emplace_back()); });
}

bool ShellInHand::take_back(Step& step) const {
  auto at = step.aside.begin();
  const bool back = at == step.aside.end() || each_array(step.checkpoint, [&](auto& array) {
                      return aside_.take(*at++, array);
                    });
  step.aside.clear();
  return back;
}

Result<void> ShellInHand::stand(const Step& step) {
  if (step.scene != scene_) {
    auto session = Session::open(step.scene, step.checkpoint.plan);
    if (!session) return tl::unexpected<Error>(session.error());
    session_ = std::move(*session);
  }
  session_->restore(step.checkpoint);
  preset_ = step.preset;
  scene_ = step.scene;
  boundary_ = step.boundary;
  taken_at_ = step.taken_at;
  sight_.push = step.push;
  sight_.first = step.first;
  sight_.layout.reset();
  steps_ = step.steps;
  kept_stroke_ = 0;
  refined_ = step.refined;
  changed_late_ = step.changed_late;
  snapped_ = step.snapped;
  design_ = step.design;
  target_ = step.target;
  return {};
}

Result<void> ShellInHand::travel(std::deque<Step>& from, std::deque<Step>& to, const char* none) {
  if (from.empty()) return fail(Fault::bad_input, none);
  Step back = std::move(from.back());
  from.pop_back();
  if (!take_back(back))
    return fail(Fault::io, "the state was put aside into a file that cannot be read");
  to.push_back(step());
  // of what is done again it is known what it was
  to.back().before_design = back.before_design;
  keep_within_memory(to);
  stroke_ = 0;
  return stand(back);
}

Result<void> ShellInHand::act(const Undo& wish, const Watch&) {
  auto back = travel(undo_, redo_, "there is nothing to undo");
  while (wish.all && back && !undo_.empty()) back = travel(undo_, redo_, "");
  return back;
}

Result<void> ShellInHand::act(const Redo&, const Watch&) {
  return travel(redo_, undo_, "there is nothing to do again");
}

// ---- deeds ----

/// Notes what a step came past; an end before its end is the error.
Result<void> ShellInHand::ended(const Report& report) {
  sight_.told = told_of(report.events);
  for (const Event& event : report.events) snapped_ = snapped_ || event.to.has_value();
  if (report.end == Outcome::cancelled) return stopped();
  if (report.end == Outcome::reached) return {};
  return fail(Fault::no_equilibrium, words_of(report.end).what);
}

Result<void> ShellInHand::form(const preset::Preset& preset, const Watch& watch) {
  const auto made = shared_scene_of(preset);
  if (!made) return tl::unexpected<Error>(made.error());
  const std::shared_ptr<const Scene>& scene = *made;
  if (scene->rung == preset::Rung::net)
    return fail(Fault::bad_input, "the rung 'net' is geometry alone: there is nothing to push");
  auto course = experiment::follow_actuation(scene, coarse_plan(*scene), false, 1, watch);
  if (!course) return tl::unexpected<Error>(course.error());
  begin_again(preset, scene, std::move(course->session));
  snapped_ = course->eventful();
  design_.reset();
  target_.reset();
  sight_.told = course->limit_reason;
  sight_.first.reset();
  for (const preset::Step& step : preset.step) {
    // what stands before a step is what it is seen against
    look();
    if (auto done = do_step(step, watch); !done) return done;
  }
  return take_push();
}

/// Another shell, which no hand has touched.
void ShellInHand::begin_again(const preset::Preset& preset, std::shared_ptr<const Scene> scene,
                              Session session) {
  preset_ = preset;
  preset_.step.clear();
  scene_ = std::move(scene);
  session_ = std::move(session);
  boundary_ = experiment::HandBoundary::of(*scene_);
  boundary_.progress = session_->progress();
  taken_at_.clear();
  steps_.clear();
  kept_stroke_ = 0;
  refined_ = changed_late_ = snapped_ = false;
  sight_.push = {};
  sight_.layout.reset();
}

/// What the preset itself pushes, from where the shell stands.
Result<void> ShellInHand::take_push() {
  if (!preset_.indentation.wanted()) return {};
  const auto push = experiment::push_of(preset_.indentation, *scene_, session_->shell().finest(),
                                        session_->nodes());
  if (!push) return tl::unexpected<Error>(push.error());
  sight_.push = {push->joint, session_->nodes().col(push->joint), push->displacement};
  return {};
}

Result<void> ShellInHand::act(const Open& wish, const Watch& watch) {
  return form(wish.preset, watch);
}

Result<void> ShellInHand::act(const Change& wish, const Watch& watch) {
  if (!session_) return form(wish.preset, watch);
  const ChangeKind kind = kind_of_change(sight_.preset, wish.preset);
  if (kind == ChangeKind::none) return {};
  if (auto agrees = check_preset(wish.preset); !agrees) return agrees;
  switch (kind) {
    case ChangeKind::none:
      break;
    case ChangeKind::looks:
      take_numbers(wish.preset);
      return {};
    case ChangeKind::accuracy: {
      auto scene = std::make_shared<Scene>(*scene_);
      scene->tolerance = wish.preset.accuracy.tolerance;
      scene->edges_per_segment = wish.preset.accuracy.edges_per_segment;
      scene->memory_GB = wish.preset.accuracy.memory_GB;
      scene_ = std::move(scene);
      preset_.accuracy = wish.preset.accuracy;
      refined_ = false;
      return {};
    }
    case ChangeKind::boundary:
      return act(Move{scene_->progress_of_radius(wish.preset.actuated_radius_mm())}, watch);
    case ChangeKind::rods:
      return put_rods(wish.preset, watch);
    case ChangeKind::shape:
      return form_anew(wish.preset, watch);
  }
  return {};
}

/// A shell of other numbers, to which nothing that the hand did is done again.
Result<void> ShellInHand::form_anew(const preset::Preset& preset, const Watch& watch) {
  const bool untouched = steps_.empty() && taken_at_.empty();
  return form(preset, watch).map([&] {
    if (untouched) return;
    if (!sight_.told.empty()) sight_.told += "; ";
    sight_.told += "formed anew, without what was done by hand: Undo brings that back";
  });
}

Result<void> ShellInHand::put_rods(const preset::Preset& preset, const Watch& watch) {
  auto scene = scene_of(preset);
  if (!scene) return tl::unexpected<Error>(scene.error());
  if (scene->rung != scene_->rung) return form_anew(preset, watch);
  const auto report = session_->set_rods(scene->rods, watch);
  if (!report) return tl::unexpected<Error>(report.error());
  if (auto done = ended(*report); !done) return done;
  take_numbers(preset);
  changed_late_ = !steps_.empty();
  return {};
}

/// All but where the boundary's motion ends, which the scene has.
void ShellInHand::take_numbers(const preset::Preset& preset) {
  const double radius = preset_.actuation.radius_mm, ratio = preset_.actuation.ratio;
  preset_ = preset;
  preset_.actuation.radius_mm = radius, preset_.actuation.ratio = ratio;
}

}  // namespace gridshell::window
