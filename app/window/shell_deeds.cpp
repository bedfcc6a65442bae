// The deeds of a hand as steps of a preset: done, and kept so that a preset can do them again.
#include <algorithm>
#include <cmath>
#include <utility>

#include "app/window/shell_in_hand.h"
#include "engine/experiment/course.h"

namespace gridshell::window {
namespace {

/// As a preset takes it: what round-off left of a zero is none.
std::vector<double> xyz_of(const Eigen::Vector3d& vector) {
  std::vector<double> xyz;
  for (const double value : vector)
    xyz.push_back(std::abs(value) < experiment::nearest_mm ? 0 : value);
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

preset::Step step_of(preset::Deed deed) {
  preset::Step step;
  step.deed = deed;
  return step;
}

/// Whether a step goes on along the way of the one before, so that its end alone counts.
bool goes_on(const preset::Step& before, const preset::Step& step) {
  if (before.deed != step.deed) return false;
  if (step.deed == preset::Deed::move)
    return before.edge_points.empty() && step.edge_points.empty();
  return step.deed == preset::Deed::push && before.joint == step.joint && !step.along.empty() &&
         before.along == step.along;
}

}  // namespace

/// One step, as a preset would have it done.
Result<void> ShellInHand::do_step(preset::Step step, const Watch& watch) {
  if (!session_) return fail(Fault::bad_input, "there is no shell yet");
  const bool holds = step.deed == preset::Deed::push || step.deed == preset::Deed::hold;
  if (holds)
    if (const auto joint = experiment::joint_of(step, scene_->footprint))
      // as it was seen, which the coarse mesh of a drag does not change
      taken_at_.emplace(*joint, sight_.frame.nodes.cols() > *joint
                                    ? Eigen::Vector3d(sight_.frame.nodes.col(*joint))
                                    : Eigen::Vector3d(session_->nodes().col(*joint)));
  // a leap is taken from a state at rest on all meshes, as a run takes it
  const bool leaps = step.deed == preset::Deed::jitter || step.deed == preset::Deed::rest ||
                     step.deed == preset::Deed::release;
  if (leaps && session_->shell().levels() == 1)
    session_->remesh(experiment::first_plan(*scene_), watch);
  const auto report = experiment::take_step(*session_, boundary_, step, watch);
  if (!report) return tl::unexpected<Error>(report.error());
  std::erase_if(taken_at_, [&](const auto& taken) {
    return std::ranges::none_of(session_->holds(),
                                [&](const Hold& hold) { return hold.node == taken.first; });
  });
  keep(std::move(step), *report);
  return ended(*report);
}

/// Notes a step as far as it came.
void ShellInHand::keep(preset::Step step, const Report& report) {
  if (report.end != Outcome::reached) {
    if (step.deed != preset::Deed::move && step.deed != preset::Deed::push) return;
    step.progress = boundary_.progress;
    if (step.deed == preset::Deed::push)
      if (const auto joint = experiment::joint_of(step, scene_->footprint))
        step.to_mm = xyz_of(session_->nodes().col(*joint));
  }
  if (step.deed == preset::Deed::move) step.edge_points = rows_of(boundary_.dragged);
  const bool eventful = !report.events.empty();
  const bool same = now_stroke_ != 0 && now_stroke_ == kept_stroke_ && !steps_.empty() &&
                    !eventful && !kept_eventful_ && goes_on(steps_.last(), step);
  if (same)
    steps_.replace_last(std::move(step));
  else
    steps_.add(std::move(step));
  kept_stroke_ = now_stroke_;
  kept_eventful_ = eventful;
}

Result<void> ShellInHand::act(const Move& wish, const Watch& watch) {
  preset::Step step = step_of(preset::Deed::move);
  step.progress = std::max(wish.progress, sight_.least_progress);
  step.edge_points = rows_of(boundary_.dragged);
  return do_step(step, watch);
}

Result<void> ShellInHand::act(const DragEdge& wish, const Watch& watch) {
  if (!session_) return fail(Fault::bad_input, "there is no shell yet");
  Eigen::Matrix3Xd dragged = boundary_.dragged;
  if (wish.edge_point < 0 || wish.edge_point >= dragged.cols())
    return fail(Fault::bad_input, "no such edge point");
  const Eigen::Index k = wish.edge_point;
  const BoundaryMotion& motion = scene_->motion;
  dragged.col(k) =
      wish.to - motion.begin.col(k) - boundary_.progress * (motion.end - motion.begin).col(k);
  if ((dragged - boundary_.dragged).norm() < experiment::nearest_mm) return {};
  preset::Step step = step_of(preset::Deed::move);
  step.progress = boundary_.progress;
  step.edge_points = rows_of(dragged);
  return do_step(step, watch);
}

Result<void> ShellInHand::act(const PutEdgeBack& wish, const Watch& watch) {
  const bool all = wish.edge_point < 0;
  Eigen::Matrix3Xd dragged = boundary_.dragged;
  if (all)
    dragged.setZero();
  else if (wish.edge_point < dragged.cols())
    dragged.col(wish.edge_point).setZero();
  if (!session_ || (dragged - boundary_.dragged).isZero(0))
    return fail(Fault::bad_input, "no such edge point was dragged");
  preset::Step step = step_of(preset::Deed::move);
  step.progress = boundary_.progress;
  step.edge_points = rows_of(dragged);
  return do_step(step, watch);
}

Result<void> ShellInHand::act(const Push& wish, const Watch& watch) {
  if (!session_) return fail(Fault::bad_input, "there is no shell yet");
  if (wish.joint < 0 || wish.joint >= int(scene_->footprint.joints.size()))
    return fail(Fault::bad_input, "no such joint");
  const FootprintJoint& joint = scene_->footprint.joints[std::size_t(wish.joint)];
  preset::Step step = step_of(preset::Deed::push);
  step.joint = {joint.i, joint.j};
  step.to_mm = xyz_of(wish.to);
  const bool free = !wish.along.isZero(0);
  if (free) step.along = xyz_of(wish.along);
  step.lateral = free ? preset::Lateral::free : preset::Lateral::held;
  // a hand that holds it already and does not move does nothing
  const Eigen::Vector3d way = wish.to - session_->nodes().col(wish.joint);
  const bool still = (free ? std::abs(way.dot(wish.along)) : way.norm()) < experiment::nearest_mm;
  if (still && taken_at_.contains(wish.joint)) return {};
  return do_step(step, watch);
}

Result<void> ShellInHand::act(const Release& wish, const Watch& watch) {
  if (!session_ || session_->holds().empty()) return fail(Fault::bad_input, "no joint is held");
  std::vector<int> joints{wish.joint};
  if (wish.joint < 0) {
    joints.clear();
    for (const Hold& hold : session_->holds()) joints.push_back(hold.node);
  }
  for (const int k : joints) {
    const FootprintJoint& joint = scene_->footprint.joints[std::size_t(k)];
    preset::Step step = step_of(preset::Deed::release);
    step.joint = {joint.i, joint.j};
    if (auto done = do_step(step, watch); !done) return done;
  }
  return {};
}

Result<void> ShellInHand::act(const Rest& wish, const Watch& watch) {
  preset::Step step = step_of(preset::Deed::rest);
  step.side = same_word<preset::RestSide>(wish.side);
  return do_step(step, watch);
}

Result<void> ShellInHand::act(const Jitter& wish, const Watch& watch) {
  if (!session_) return fail(Fault::bad_input, "there is no shell yet");
  preset::Step step = step_of(preset::Deed::jitter);
  step.seed = wish.seed;
  step.force_N = 20 * preset_.jitter.field_N_per_mm * scene_->footprint.spacing;
  return do_step(step, watch);
}

}  // namespace gridshell::window
