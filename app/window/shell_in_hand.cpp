#include "app/window/shell_in_hand.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "app/window/preset_change.h"
#include "engine/core/clock.h"
#include "engine/experiment/actuation.h"
#include "engine/experiment/indentation.h"
#include "engine/scene/scene_rods.h"

namespace gridshell::window {
namespace {

constexpr std::size_t most_bytes = 400u << 20;  // of steps to undo
constexpr double nearest_mm = 1e-9;             // moves below are none

std::size_t bytes_of(const Checkpoint& kept) {
  std::size_t doubles = 0;
  for (const State& level : kept.state.levels)
    doubles += std::size_t(level.x.size() + level.force.size() + level.director.size());
  for (const PinnedMotion& motion : kept.motions)
    doubles += std::size_t(motion.begin.size() + motion.change.size());
  return sizeof(double) * (doubles + std::size_t(kept.state.x.size()));
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

/// The artificial gravity of a jitter, on the joints: one random force each.
std::vector<NodeAction> random_field(const Scene& scene, const preset::Preset& preset, int seed) {
  std::mt19937 random{std::uint32_t(seed)};
  // not by a distribution of the standard library, whose numbers differ from one to the next
  const auto draw = [&] { return 2.0 * double(random()) / double(random.max()) - 1; };
  const double force = 20 * preset.jitter.field_N_per_mm * scene.footprint.spacing;
  std::vector<NodeAction> field;
  for (int joint = 0; joint < int(scene.footprint.joints.size()); ++joint)
    field.push_back({joint, force * Eigen::Vector3d(draw(), draw(), draw())});
  return field;
}

}  // namespace

LevelPlan coarse_plan(const Scene& scene) {
  return {{experiment::first_plan(scene).edges_per_segment.front()}, false};
}

void ShellInHand::fulfil(const Wish& wish, const Watch& watch) {
  const double begin = seconds_now();
  sight_.trouble.clear();
  sight_.told.clear();
  const bool remembered = remember(wish);
  if (session_ && wish.passing && session_->shell().levels() > 1) coarsen(watch);
  const auto done = std::visit([&](const auto& deed) { return act(deed, watch); }, wish.deed);
  if (!done)
    sight_.trouble = done.error().fault == Fault::cancelled ? "stopped" : done.error().message;
  // what moved nothing is no step
  if (!done && remembered && undo_.back().scene == scene_ &&
      undo_.back().checkpoint.state.x == session_->nodes()) {
    undo_.pop_back();
    stroke_ = 0;
  }
  // whether these meshes still meet the tolerance is for refine() to find out
  const bool travelled =
      std::holds_alternative<Undo>(wish.deed) || std::holds_alternative<Redo>(wish.deed);
  if (!travelled) refined_ = false;
  look();
  sight_.seconds = seconds_now() - begin;
}

void ShellInHand::refine(const Watch& watch) {
  if (!session_ || refined_) return;
  const double begin = seconds_now();
  // a shell that nothing happened to since it was formed
  const bool untouched = sight_.first.nodes.cols() == sight_.frame.nodes.cols() &&
                         sight_.first.nodes == sight_.frame.nodes;
  const LevelPlan plan = experiment::first_plan(*scene_);
  const std::vector<int>& now = session_->shell().plan().edges_per_segment;
  const bool fine_enough = scene_->edges_per_segment == 0 && now.size() > 1 &&
                           now.back() >= plan.edges_per_segment.back();
  if (!fine_enough && now != plan.edges_per_segment) {
    const auto fine = session_->remesh(plan, watch);
    if (watch.cancelled()) return;
    if (!fine || fine->end != Outcome::reached) {
      sight_.trouble = "finer meshes do not have this state";
      refined_ = true;
      return look();
    }
  }
  if (scene_->edges_per_segment == 0)
    session_->refine(scene_->tolerance * scene_->length_scale_mm, watch);
  refined_ = !watch.cancelled();
  look();
  if (untouched) sight_.first = sight_.frame;
  sight_.seconds = seconds_now() - begin;
}

void ShellInHand::coarsen(const Watch& watch) {
  // where the coarse mesh does not have this state, the drag goes on on the finer ones
  session_->remesh(coarse_plan(*scene_), watch);
}

// ---- steps ----

ShellInHand::Step ShellInHand::step() const {
  return {preset_,   scene_,      session_->save(), progress_, dragged_,
          taken_at_, sight_.push, sight_.first,     refined_,  jittered_};
}

/// Keeps the state before a wish, but for one of the stroke that the last step began.
bool ShellInHand::remember(const Wish& wish) {
  const bool travels = std::holds_alternative<Undo>(wish.deed) ||
                       std::holds_alternative<Redo>(wish.deed) ||
                       std::holds_alternative<Settle>(wish.deed);
  if (travels || !session_ || (wish.stroke != 0 && wish.stroke == stroke_)) return false;
  stroke_ = wish.stroke;
  redo_.clear();
  undo_.push_back(step());
  std::size_t bytes = 0;
  for (auto one = undo_.rbegin(); one != undo_.rend(); ++one) bytes += bytes_of(one->checkpoint);
  while (bytes > most_bytes && undo_.size() > 1) {
    bytes -= bytes_of(undo_.front().checkpoint);
    undo_.pop_front();
  }
  return true;
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
  progress_ = step.progress;
  dragged_ = step.dragged;
  taken_at_ = step.taken_at;
  sight_.push = step.push;
  sight_.first = step.first;
  sight_.layout.reset();
  refined_ = step.refined;
  jittered_ = step.jittered;
  return {};
}

Result<void> ShellInHand::travel(std::deque<Step>& from, std::deque<Step>& to, const char* none) {
  if (from.empty()) return fail(Fault::bad_input, none);
  to.push_back(step());
  Step back = std::move(from.back());
  from.pop_back();
  stroke_ = 0;
  return stand(back);
}

Result<void> ShellInHand::act(const Undo&, const Watch&) {
  return travel(undo_, redo_, "there is nothing to undo");
}

Result<void> ShellInHand::act(const Redo&, const Watch&) {
  return travel(redo_, undo_, "there is nothing to do again");
}

// ---- deeds ----

/// Notes what a step came past; an end before its end is the error.
Result<void> ShellInHand::ended(const Report& report) {
  sight_.told = told_of(report.events);
  if (report.end == Outcome::cancelled) return fail(Fault::cancelled, "stopped");
  if (report.end == Outcome::reached) return {};
  return fail(Fault::no_equilibrium, words_of(report.end).what);
}

Result<void> ShellInHand::form(const preset::Preset& preset, const Watch& watch) {
  auto made = scene_of(preset);
  if (!made) return tl::unexpected<Error>(made.error());
  if (made->rung == preset::Rung::net)
    return fail(Fault::bad_input, "the rung 'net' is geometry alone: there is nothing to push");
  const auto scene = std::make_shared<const Scene>(std::move(*made));
  auto course = experiment::follow_actuation(scene, coarse_plan(*scene), false, 1, watch);
  if (!course) return tl::unexpected<Error>(course.error());
  preset_ = preset;
  scene_ = scene;
  session_ = std::move(course->session);
  progress_ = session_->progress();
  dragged_ = Eigen::Matrix3Xd::Zero(3, scene->motion.begin.cols());
  taken_at_.clear();
  refined_ = jittered_ = false;
  sight_.told = course->limit_reason;
  sight_.push = {};
  sight_.layout.reset();
  sight_.first = {};
  if (!preset.indentation.wanted()) return {};
  const auto push = experiment::push_of(preset.indentation, *scene, session_->shell().finest(),
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
    case ChangeKind::looks: {
      const double radius = preset_.actuation.radius_mm, ratio = preset_.actuation.ratio;
      preset_ = wish.preset;
      preset_.actuation.radius_mm = radius, preset_.actuation.ratio = ratio;
      return {};
    }
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
    case ChangeKind::boundary: {
      const double from = scene_->radius_begin_mm, to = scene_->radius_end_mm;
      return act(Move{(from - wish.preset.actuated_radius_mm()) / (from - to)}, watch);
    }
    case ChangeKind::rods:
      return put_rods(wish.preset, watch);
    case ChangeKind::shape:
      return form(wish.preset, watch);
  }
  return {};
}

Result<void> ShellInHand::put_rods(const preset::Preset& preset, const Watch& watch) {
  auto scene = scene_of(preset);
  if (!scene) return tl::unexpected<Error>(scene.error());
  if (scene->rung != scene_->rung) return form(preset, watch);
  const auto report = session_->set_rods(scene->rods, watch);
  if (!report) return tl::unexpected<Error>(report.error());
  if (auto done = ended(*report); !done) return done;
  const double radius = preset_.actuation.radius_mm, ratio = preset_.actuation.ratio;
  preset_ = preset;
  preset_.actuation.radius_mm = radius, preset_.actuation.ratio = ratio;
  return {};
}

Result<void> ShellInHand::act(const Move& wish, const Watch& watch) {
  if (!session_) return fail(Fault::bad_input, "there is no shell yet");
  return put_boundary(std::max(wish.progress, sight_.least_progress), dragged_, watch);
}

/// The boundary to where the scene's motion has it, with the edge points dragged off it.
Result<void> ShellInHand::put_boundary(double progress, const Eigen::Matrix3Xd& dragged,
                                       const Watch& watch) {
  if (dragged.isZero(0) && dragged_.isZero(0)) {
    const auto done = ended(session_->move_to(progress, watch));
    progress_ = session_->progress();
    return done;
  }
  BoundaryMotion motion = scene_->motion;
  const Eigen::Matrix3Xd way = motion.end - motion.begin;
  motion.end = motion.begin + progress * way + dragged;
  const Report report = session_->rebase(motion, watch);
  const auto done = ended(report);
  const double part = report.t;
  progress_ += part * (progress - progress_);
  dragged_ += part * (dragged - dragged_);
  return done;
}

Result<void> ShellInHand::act(const DragEdge& wish, const Watch& watch) {
  if (!session_) return fail(Fault::bad_input, "there is no shell yet");
  if (wish.edge_point < 0 || wish.edge_point >= dragged_.cols())
    return fail(Fault::bad_input, "no such edge point");
  if (scene_->motion.end_tangent.cols() > 0 || scene_->motion.end_far.cols() > 0)
    return fail(Fault::bad_input, "ends whose direction is held cannot be dragged one by one");
  const Eigen::Index k = wish.edge_point;
  const Eigen::Vector3d place =
      scene_->motion.begin.col(k) + progress_ * (scene_->motion.end - scene_->motion.begin).col(k);
  Eigen::Matrix3Xd dragged = dragged_;
  dragged.col(k) = wish.to - place;
  if ((dragged - dragged_).norm() < nearest_mm) return {};
  return put_boundary(progress_, dragged, watch);
}

Result<void> ShellInHand::act(const Push& wish, const Watch& watch) {
  if (!session_) return fail(Fault::bad_input, "there is no shell yet");
  if (wish.joint < 0 || wish.joint >= int(scene_->footprint.joints.size()))
    return fail(Fault::bad_input, "no such joint");
  const Eigen::Vector3d at = session_->nodes().col(wish.joint);
  // as it was seen, which the coarse mesh of a drag does not change
  const Eigen::Vector3d seen = sight_.frame.nodes.col(wish.joint);
  const bool first = taken_at_.emplace(wish.joint, seen).second;
  Eigen::Vector3d way = wish.to - at;
  const bool free = !wish.along.isZero(0);
  if (free) way = wish.along * wish.along.dot(way);
  if (way.norm() < nearest_mm && !first) return {};
  // a hand that does not move yet takes hold along its own direction
  if (way.norm() < nearest_mm) way = nearest_mm * (free ? wish.along : Eigen::Vector3d::UnitZ());
  return ended(session_->push(wish.joint, way, free ? Across::free : Across::held, watch));
}

Result<void> ShellInHand::act(const Release& wish, const Watch& watch) {
  if (!session_ || session_->holds().empty()) return fail(Fault::bad_input, "no joint is held");
  std::vector<int> joints{wish.joint};
  if (wish.joint < 0) {
    joints.clear();
    for (const Hold& hold : session_->holds()) joints.push_back(hold.node);
  }
  for (int joint : joints) {
    if (auto done = ended(session_->release(joint, watch)); !done) return done;
    taken_at_.erase(joint);
  }
  return {};
}

Result<void> ShellInHand::act(const Rest& wish, const Watch& watch) {
  if (!session_) return fail(Fault::bad_input, "there is no shell yet");
  return ended(session_->rest(watch, wish.side));
}

Result<void> ShellInHand::act(const Jitter& wish, const Watch& watch) {
  if (!session_) return fail(Fault::bad_input, "there is no shell yet");
  const Checkpoint before = session_->save();
  const auto thrown = ended(session_->set_field(random_field(*scene_, preset_, wish.seed), watch));
  // a field that the shell cannot bear all the way has moved it as well
  if (watch.cancelled()) return session_->restore(before), thrown;
  const auto back = ended(session_->set_field({}, watch));
  if (back)
    jittered_ = true;
  else
    session_->restore(before);
  return back;
}

}  // namespace gridshell::window
