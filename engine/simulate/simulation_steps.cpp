// The commands of a user to a simulation: each replaces the path by a drive of its own, or
// minimises the energy at the current boundary.
#include <algorithm>
#include <utility>

#include "engine/core/try.h"
#include "engine/simulate/branch_switch.h"
#include "engine/simulate/expected_cost.h"
#include "engine/simulate/simulation.h"

namespace gridshell {
namespace {

/// The load `b` minus the load `a`: the increment from one to the other.
std::vector<NodeAction> difference(std::vector<NodeAction> b, const std::vector<NodeAction>& a) {
  for (NodeAction action : a) b.push_back(action *= -1);
  return b;
}

std::vector<NodeAction> times(std::vector<NodeAction> actions, double factor) {
  for (NodeAction& action : actions) action *= factor;
  return actions;
}

}  // namespace

LoadFactor Simulation::steady_load() const { return {load_scale_ * progress_, 0}; }

void Simulation::apply_field(std::vector<NodeAction> field) {
  field_ = std::move(field);
  shell_->set_fields(field_, {});
}

/// Certifies the current state as the start of a motion that was just prescribed. If that fails, it
/// restores `before`.
Outcome Simulation::start_here(double t, const Checkpoint& before, const Watch& watch) {
  const Outcome end = shell_->start(t, shell_->state().levels.back(), watch).end;
  if (end != Outcome::reached) restore(before);
  return end;
}

/// Drives the shell from the current state, to the end if possible.
Report Simulation::drive(const PrescribedMove& drive, std::vector<NodeAction> coming,
                         const Watch& watch, PathRecord* record) {
  const CallBegin begin = call_begin();
  const Checkpoint before = save();
  const std::vector<Constraint> constraints = drive.constraints;
  shell_->set_fields(field_, coming);
  shell_->drive(drive);
  constraints_ = constraints;
  actuating_ = false;
  first_stiffness_ = 0;
  const Outcome started = start_here(0, before, watch);
  if (started != Outcome::reached) return report(started, 0, begin);
  Report done = go(1, watch, {}, record);
  std::vector<NodeAction> field = field_;
  const auto come = times(std::move(coming), drive.field.begin + done.t * drive.field.change);
  field.insert(field.end(), come.begin(), come.end());
  std::erase_if(field, [](const NodeAction& action) { return action.is_none(); });
  apply_field(std::move(field));
  return done;
}

Report Simulation::move_to(double progress, const Watch& watch, PathRecord* record) {
  const double t = parameter_at(progress);
  if (!actuating_) {
    const double now = parameter_at(progress_);
    const Checkpoint before = save();
    shell_->actuate(now, constraints_, load_scale_);
    actuating_ = true;
    const Outcome started = start_here(now, before, watch);
    if (started != Outcome::reached) return report(started, now, call_begin());
  }
  return go(t, watch, {}, record);
}

Report Simulation::move_edge_points(double progress, const Eigen::Matrix3Xd& dragged,
                                    const Watch& watch) {
  BoundaryMotion motion = scene_->motion;
  motion.end = motion.begin + progress * (motion.end - motion.begin) + dragged;
  motion.end_joints = motion.begin_joints + progress * (motion.end_joints - motion.begin_joints);
  // dead loads grow with the progress
  const double change = progress - progress_;
  const LoadFactor load{steady_load().begin, load_scale_ * change};
  Report done =
      drive({.constraints = constraints_, .displacements = {}, .boundary = motion, .load = load},
            {}, watch);
  progress_ += done.t * change;
  dragged_ += done.t * (dragged - dragged_);
  return done;
}

Report Simulation::begin_push(int joint, const Eigen::Vector3d& displacement, Across across,
                              const Watch& watch) {
  const CallBegin begin = call_begin();
  const Checkpoint before = save();
  const LoadFactor load = steady_load();
  std::vector<Constraint> constraints = constraints_;
  std::erase_if(constraints, [&](const Constraint& one) { return one.node == joint; });
  Constraint constraint{joint};
  if (across == Across::free) constraint.directions = displacement.normalized();
  constraints.push_back(constraint);
  // a push that continues the last one is compared with the stiffness at the start of that one
  const bool goes_on = !constraints_.empty() && constraints_.back().node == joint &&
                       constraints_.back().directions.cols() == constraint.directions.cols() &&
                       constraints_.back().part(displacement).isApprox(displacement, 1e-6);
  const double first_stiffness = goes_on ? first_stiffness_ : 0;
  std::vector<Eigen::Vector3d> displacements(constraints.size(), Eigen::Vector3d::Zero());
  displacements.back() = displacement;
  Eigen::Index entries = 0;
  for (const Constraint& one : constraints) entries += one.directions.cols();
  along_.setZero(entries);
  along_.tail(constraint.directions.cols()) = constraint.directions.transpose() * displacement;
  along_.normalize();
  shell_->drive(
      {.constraints = constraints, .displacements = std::move(displacements), .load = load});
  constraints_ = std::move(constraints);
  actuating_ = false;
  const Outcome started = start_here(0, before, watch);
  if (started == Outcome::reached)
    first_stiffness_ = first_stiffness > 0 ? first_stiffness : push_stiffness();
  return report(started, shell_->state().t, begin);
}

Report Simulation::push(int joint, const Eigen::Vector3d& displacement, Across across,
                        const Watch& watch, PathRecord* record) {
  const Report begun = begin_push(joint, displacement, across, watch);
  return begun.end == Outcome::reached ? go(1, watch, {}, record) : begun;
}

Report Simulation::release(int joint, const Watch& watch) {
  std::vector<Constraint> left = constraints_;
  std::vector<NodeAction> force;
  for (std::size_t k = 0; k < constraints_.size(); ++k)
    if (constraints_[k].node == joint)
      force.push_back({joint, constraints_[k].part(this->force(k))});
  std::erase_if(left, [&](const Constraint& constraint) { return constraint.node == joint; });
  const LoadFactor load = steady_load();
  const Checkpoint constrained = save();
  Report done =
      drive({.constraints = left, .load = load, .field = {1, -1}}, std::move(force), watch);
  if (done.end == Outcome::reached || done.end == Outcome::too_coarse || at_limit(done.end) ||
      watch.cancelled())
    return done;
  // the state was stable with the constraint but is not under the same force: the constraint is
  // removed, and the energy minimised
  restore(constrained);
  shell_->drive({.constraints = left, .load = load});
  constraints_ = left;
  actuating_ = false;
  first_stiffness_ = 0;
  const auto found = minimise_from(shell_->system(), shell_->state().levels.back(), watch);
  Outcome end = Outcome::not_converged;
  if (found) end = shell_->start(1, *found, watch).end;
  if (end != Outcome::reached) restore(constrained);
  done.certificate = certificate();
  done.end = watch.cancelled() ? Outcome::cancelled : end;
  if (done.end != Outcome::reached) return done;
  // the shell has snapped from where the force could not be reduced further
  if (done.events.empty() || done.events.back().to)
    done.events.push_back({Event::Kind::stability_lost, done.t, {}, {}});
  done.events.back().to = done.t;
  done.t = 1;
  return done;
}

Report Simulation::load(double factor, const Watch& watch) {
  for (const CaseOnShell& one : cases) factor += one.factor * one.dead;
  const double change = factor - load_scale_;
  const LoadFactor load{steady_load().begin, change * progress_};
  Report done = drive({.constraints = constraints_, .load = load}, {}, watch);
  load_scale_ += done.t * change;
  return done;
}

Report Simulation::set_field(std::vector<NodeAction> field, const Watch& watch, double dead) {
  const LoadFactor load{steady_load().begin, dead * progress_};
  const std::vector<NodeAction> coming = difference(field, field_);
  Report done = drive({.constraints = constraints_, .load = load, .field = {0, 1}}, coming, watch);
  load_scale_ += done.t * dead;
  if (done.end == Outcome::reached) apply_field(std::move(field));
  return done;
}

Report Simulation::open_joints(const Watch& watch, PathRecord* record) {
  const LoadFactor load = steady_load();
  return drive({.constraints = constraints_, .load = load, .opening = {0, 1}}, {}, watch, record);
}

Report Simulation::rest(const Watch& watch, BranchSide side) {
  const CallBegin begin = call_begin();
  const Checkpoint good = save();
  const double t = shell_->state().t;
  BranchSwitch departure = departure_of(*scene_, shell_->finest(), shell_->model());
  if (side != BranchSide::lower) departure.side = side;
  const auto found =
      minimise_from(shell_->system(), shell_->state().levels.back(), watch, departure);
  Outcome end = watch.cancelled() ? Outcome::cancelled : Outcome::not_converged;
  if (found) end = shell_->start(t, *found, watch).end;
  if (end != Outcome::reached) restore(good);
  return report(end, t, begin);
}

Report Simulation::rest_in_time(const Watch& watch,
                                const std::function<void(const MovingState&)>& seen) {
  const CallBegin begin = call_begin();
  const Checkpoint good = save();
  Outcome end = Outcome::not_converged;
  if (const auto rest =
          gridshell::rest_in_time(*shell_, *scene_, shell_->state().levels.back(), {}, seen, watch))
    end = shell_->start(shell_->state().t, *rest, watch).end;
  if (watch.cancelled()) end = Outcome::cancelled;
  if (end != Outcome::reached) restore(good);
  return report(end, shell_->state().t, begin);
}

Result<Report> Simulation::set_rods(const ShellRods& rods, const Watch& watch) {
  const CallBegin begin = call_begin();
  std::optional<ShellRods> old = std::exchange(rods_, rods);
  auto built = std::exchange(built_, {});
  const auto taken = replace_meshes(shell_->plan(), true, watch);
  if (!taken || *taken != Outcome::reached) {
    rods_ = std::move(old);
    built_ = std::move(built);
  }
  if (!taken) return tl::unexpected<Error>(taken.error());
  return report(*taken, shell_->state().t, begin);
}

Result<Report> Simulation::remesh(const LevelPlan& plan, const Watch& watch) {
  const CallBegin begin = call_begin();
  TRY(taken, replace_meshes(plan, false, watch));
  return report(*taken, shell_->state().t, begin);
}

Report Simulation::refine(double tolerance_mm, const Watch& watch) {
  const CallBegin begin = call_begin();
  Outcome end = Outcome::reached;
  while (end == Outcome::reached && !(certificate().error_estimate_mm <= tolerance_mm)) {
    const auto plan = finer(shell_->plan());
    if (!plan || !fits_memory(*scene_, *plan)) break;
    end = replace_meshes(*plan, false, watch).value_or(Outcome::not_converged);
  }
  return report(end, shell_->state().t, begin);
}

}  // namespace gridshell
