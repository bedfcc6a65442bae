#include "engine/session/session.h"

#include <algorithm>
#include <cmath>

#include "engine/core/clock.h"
#include "engine/scene/net_design.h"
#include "engine/solve/buckle.h"
#include "engine/solve/minimise.h"
#include "engine/solve/rest.h"

namespace gridshell {
namespace {

constexpr double push_step = 0.02;        // of the length scale: the largest load step
constexpr double actuation_step = 0.05;   // in the path parameter
constexpr double stiffness_growth = 100;  // at which the rods are at their length
constexpr double locate_mm = 5e-3;        // of prescribed move: to which a limit is located
constexpr double still_mm = 0.01;         // what an unstable rest is pushed by in a snap in time

/// `b` in the place of `a`: what comes on beside `a` as it goes.
std::vector<NodeAction> difference(std::vector<NodeAction> b, const std::vector<NodeAction>& a) {
  for (NodeAction action : a) {
    action.force *= -1;
    action.stiffness *= -1;
    b.push_back(action);
  }
  return b;
}

std::vector<NodeAction> times(std::vector<NodeAction> actions, double factor) {
  for (NodeAction& action : actions) action.force *= factor, action.stiffness *= factor;
  return actions;
}

PathOptions options_for(const Scene& scene) {
  PathOptions options;
  options.spacing_mm = scene.footprint.spacing;
  // far below what the meshes leave, so that it does not show in the differences between them
  options.tolerance_mm = std::clamp(1e-3 * scene.tolerance * scene.length_scale_mm, 1e-7, 1e-4);
  return options;
}

}  // namespace

Result<Session> Session::open(std::shared_ptr<const Scene> scene, const LevelPlan& plan) {
  Session session(std::move(scene));
  if (auto built = session.build(plan); !built) return tl::unexpected<Error>(built.error());
  return session;
}

Result<void> Session::build(const LevelPlan& plan) {
  auto shell = NestedShell::make(scene_->footprint, rods_ ? *rods_ : scene_->rods,
                                 scene_->mechanics(), scene_->motion, plan, options_for(*scene_));
  if (!shell) return tl::unexpected<Error>(shell.error());
  if (shell_) spent_ += shell_->effort();
  shell_ = std::make_unique<NestedShell>(std::move(*shell));
  return {};
}

// ---- reports ----

Certificate Session::certificate() const {
  const NestedState& state = shell_->state();
  return {state.residual_N, state.inertia.negative_pivots, state.error_estimate_mm,
          state.largest_strain};
}

Report Session::report(Outcome end, double t, const Effort& before, double begin) const {
  Report report;
  report.end = end;
  report.t = t;
  report.certificate = certificate();
  report.effort = effort() - before;
  report.seconds = seconds_now() - begin;
  return report;
}

Energies Session::energies() const {
  const int last = shell_->levels() - 1;
  const Energies fine = shell_->energies(last);
  if (!shell_->plan().extrapolate || last == 0) return fine;
  return (4 * fine - shell_->energies(last - 1)) / 3;
}

bool Session::locked() const {
  const NestedState& state = shell_->state();
  if (state.largest_strain > scene_->max_strain) return true;
  if (actuating_ || holds_.empty() || !(first_stiffness_ > 0)) return false;
  return push_stiffness() > stiffness_growth * first_stiffness_;
}

double Session::push_stiffness() const {
  return along_.dot(shell_->state().held_stiffness * along_);
}

// ---- begin ----

Report Session::begin_flat() {
  const double begin = seconds_now();
  const Effort before = effort();
  NestedState flat;
  for (int k = 0; k < shell_->levels(); ++k) {
    Linearisation& system = shell_->system(k);
    flat.levels.push_back(
        flat_state(shell_->model(k), shell_->mesh(k), shell_->motion(k), scene_->flat));
    shell_->motion(k).load_up(system, 0);
    if (k + 1 < shell_->levels()) continue;
    flat.inertia = system.at(flat.levels.back(), false);
    flat.residual_N = system.residual();
    flat.x = nodes_of(shell_->mesh(k), shell_->model(k), flat.levels.back().x);
  }
  std::vector<PinnedMotion> motions;
  for (int k = 0; k < shell_->levels(); ++k) motions.push_back(shell_->motion(k));
  shell_->restore(flat, motions, {});
  actuating_ = true;
  progress_ = 0;
  return report(Outcome::reached, 0, before, begin);
}

/// The buckled shape of the bend rung, which every rung starts from: what twist and springs add
/// does not choose the branch.
Result<State> Session::first_shape(double t, const Watch& watch) {
  const RodMesh& mesh = shell_->mesh(0);
  const PinnedMotion& motion = shell_->motion(0);
  if (scene_->mechanics() == Rung::bend)
    return first_buckled(shell_->system(0), mesh, motion, t, scene_->seed, scene_->flat, watch);
  const auto bend = build_model(mesh, rods_ ? *rods_ : scene_->rods, Rung::bend);
  if (!bend) return tl::unexpected<Error>(bend.error());
  Linearisation system(*bend);
  const auto shape = first_buckled(system, mesh, motion, t, scene_->seed, scene_->flat, watch);
  if (!shape) return shape;
  const Model& model = shell_->model(0);
  State state = flat_state(model, mesh, motion, scene_->flat);
  gridshell::move_to(model, columns_of(mesh, model, shape->x), state);
  motion.impose(shell_->system(0), t, state);
  return rest_below(shell_->system(0), std::move(state), watch);
}

Result<Report> Session::begin_buckled(double shortening, const Watch& watch) {
  const double begin = seconds_now();
  const Effort before = effort();
  const auto t = parameter_of_shortening(shell_->mesh(0), shell_->motion(0), shortening);
  if (!t) return tl::unexpected<Error>(t.error());
  auto first = first_shape(*t, watch);
  if (!first) return tl::unexpected<Error>(first.error());
  Report report = begin_at(*t, *first, watch);
  report.effort = effort() - before;
  report.seconds = seconds_now() - begin;
  return report;
}

Result<Report> Session::begin_on_net(const Watch& watch) {
  const RodMesh& mesh = shell_->mesh(0);
  const Eigen::Matrix2Xd flat = mesh.flat.leftCols(mesh.rod_nodes());
  // blocks that meet with a gap would tear the rods between them
  auto net = scene_->blocks ? scene_->blocks->closed(flat, 4 * scene_->footprint.spacing)
                            : points_on(*scene_->net, flat);
  if (!net) return tl::unexpected<Error>(net.error());
  net->conservativeResize(3, mesh.nodes());
  net->rightCols(mesh.ghosts) = shell_->motion(0).at(1).middleCols(mesh.rod_nodes(), mesh.ghosts);
  const Model& model = shell_->model(0);
  State state = flat_state(model, mesh, shell_->motion(0), scene_->flat);
  gridshell::move_to(model, columns_of(mesh, model, *net), state);
  shell_->motion(0).impose(shell_->system(0), 1, state);
  auto rest = rest_near(shell_->system(0), state, 0.5 * scene_->footprint.spacing, watch);
  if (!rest) return fail(rest.error().fault, "next to the net there is " + rest.error().message);
  return begin_at(1, *rest, watch);
}

Report Session::begin_at(double t, const State& coarse, const Watch& watch) {
  const double begin = seconds_now();
  const Effort before = effort();
  actuating_ = true;
  holds_.clear();
  shell_->actuate(t, {}, load_scale_);
  const NestedReport nested = shell_->start(t, coarse, watch);
  if (nested.end == Outcome::reached) progress_ = t * t;
  return report(nested.end, nested.t, before, begin);
}

Report Session::begin_from(const Session& other, const Watch& watch) {
  return begin_at(std::sqrt(other.progress_), shell_->from(*other.shell_), watch);
}

// ---- move ----

double Session::load_step() const {
  if (actuating_) return actuation_step;
  const double reach = shell_->reach_mm();
  return reach > 0 ? push_step * scene_->length_scale_mm / reach : 0.1;
}

Report Session::go(double t, const Watch& watch, const Leaving& leaving, Trail* trail) {
  const double begin = seconds_now();
  const Effort before = effort();
  std::vector<Event> events;
  const auto end = [&](Outcome outcome) {
    shell_->allow_unstable(false);
    // the leader may stand ahead of what is certified
    if (outcome != Outcome::reached && outcome != Outcome::locked) shell_->back_to(shell_->state());
    Report done = report(outcome, shell_->state().t, before, begin);
    done.events = std::move(events);
    if (actuating_) progress_ = done.t * done.t;
    return done;
  };
  const auto station = [&] {
    if (trail) trail->stations.push_back({shell_->followed(), certificate()});
  };
  shell_->allow_unstable(leaving.through_unstable);
  station();
  while (shell_->state().t != t) {
    if (watch.cancelled()) return end(Outcome::cancelled);
    const double now = shell_->state().t, left = t - now, step = load_step();
    const int steps = std::max(1, int(std::ceil(std::abs(left) / step - 1e-9)));
    const double next = steps == 1 ? t : now + left / steps;
    const Checkpoint good = save();
    const NestedReport nested = shell_->advance(next, watch);
    if (nested.end == Outcome::cancelled) return end(Outcome::cancelled);
    if (nested.end == Outcome::reached) {
      if (locked()) {
        to_lock(next, now, good, watch);
        events.push_back({Event::Kind::locked, shell_->state().t, {}});
        return end(Outcome::locked);
      }
      station();
      continue;
    }
    const bool branch_ended = nested.end == Outcome::unstable || nested.end == Outcome::lost;
    if (!leaving.wanted || !branch_ended || events.size() >= 8) return end(nested.end);
    events.push_back(
        {nested.end == Outcome::unstable ? Event::Kind::stability_lost : Event::Kind::turned_back,
         shell_->followed().t,
         {}});
    if (!leave(t, events.back(), trail, watch))
      return end(watch.cancelled() ? Outcome::cancelled : nested.end);
    if (locked()) {
      // the rest beyond is none of rods as long as these
      shell_->back_to(good.state);
      events.back() = {Event::Kind::locked, shell_->state().t, {}};
      return end(Outcome::locked);
    }
    station();
  }
  return end(Outcome::reached);
}

/// Other meshes or rods in the place of these, at rest where these stand; if they are not, these
/// stay.
Result<Outcome> Session::take_over(const LevelPlan& plan, bool nearby, const Watch& watch) {
  std::unique_ptr<NestedShell> before = std::move(shell_);
  const auto back = [&] {
    if (shell_) spent_ += shell_->effort();
    shell_ = std::move(before);
  };
  if (auto built = build(plan); !built) {
    back();
    return tl::unexpected<Error>(built.error());
  }
  shell_->set_fields(field_, {});
  const double t = actuating_ ? before->state().t : 0;
  State state = shell_->stay(*before, holds_);
  if (actuating_) shell_->actuate(t, holds_, load_scale_);
  if (nearby) {
    shell_->motion(0).load_up(shell_->system(0), t);
    if (auto rest = rest_near(shell_->system(0), state, 0.5 * scene_->footprint.spacing, watch))
      state = std::move(*rest);
  }
  Outcome end = shell_->start(t, state, watch).end;
  if (watch.cancelled()) end = Outcome::cancelled;
  if (end == Outcome::reached)
    spent_ += before->effort();
  else
    back();
  return end;
}

/// Between two states the rods come to their length: finds where, and stands there.
void Session::to_lock(double beyond, double unlocked, const Checkpoint& good, const Watch& watch) {
  const double reach = std::max(shell_->reach_mm(), 1e-9);
  NestedState last = good.state;
  double bad = beyond, fine = unlocked;
  while (std::abs(bad - fine) * reach > locate_mm && !watch.cancelled()) {
    shell_->back_to(last);
    const double middle = 0.5 * (fine + bad);
    if (shell_->advance(middle, watch).end == Outcome::reached && !locked()) {
      last = shell_->state();
      fine = middle;
    } else {
      bad = middle;
    }
  }
  shell_->back_to(last);
}

Result<State> Session::leave_to(double there, Trail* trail, const Watch& watch) {
  const PathPoint& last = shell_->followed();
  Linearisation& system = shell_->system(0);
  const PinnedMotion& motion = shell_->motion(0);
  if (!scene_->snap.wanted) return leave_branch(system, motion, last, there, watch);
  motion.load_up(system, last.t);
  system.at(last.state, false);
  const Eigen::Matrix3Xd mode = softest_mode(system, watch);
  State state = last.state;
  motion.impose(system, there, state);
  // to the side on which the energy falls
  const double push = 2 * still_mm / largest_column(mode);
  State sides[2] = {state, state};
  for (int k = 0; k < 2; ++k)
    gridshell::move_to(system.model(), state.x + (k == 0 ? push : -push) * mode, sides[k]);
  state = system.energy_at(sides[0]) <= system.energy_at(sides[1]) ? sides[0] : sides[1];
  const auto mass = lumped_mass(system.model(), scene_->mass_t_per_mm);
  if (!mass) return tl::unexpected<Error>(mass.error());
  DynamicsOptions options;
  options.step_s = scene_->snap.step_s;
  options.damping_per_s = scene_->snap.damping_per_s;
  options.tolerance_mm = 1e-7;
  DampedMotion damped(system.model(), *mass, options, system.outside, system.holds());
  MovingState moving = MovingState::at_rest(state);
  std::vector<Moment> seen;
  const auto settled = damped.settle(
      moving, {.still_N = 1e-4, .still_mJ = 1e-7},
      [&](const MovingState& now) {
        if (trail) seen.push_back({now.time, now.state});
      },
      watch);
  if (!settled) return tl::unexpected<Error>(settled.error());
  system.gradient_at(moving.state);
  moving.state.force = system.assembly().force;
  if (minimise(system, moving.state, {}, watch).outcome != Outcome::reached)
    return fail(Fault::no_equilibrium, "the motion did not end near a rest");
  if (trail) trail->snaps.push_back({trail->stations.size() - 1, std::move(seen)});
  return moving.state;
}

/// The branch ended: comes to rest again a little further on. The meshes lose it at slightly
/// different places; beyond the last of them all find the new state.
bool Session::leave(double t, Event& event, Trail* trail, const Watch& watch) {
  const PathPoint last = shell_->followed();
  const double way = t > last.t ? 1 : -1;
  const double speed =
      std::max(shell_->reach_mm() * shell_->motion(0).speed(last.t), 0.1);  // mm by t
  for (double beyond = 1e-3; beyond < 0.1; beyond *= 2) {
    double there = last.t + way * beyond * scene_->length_scale_mm / speed;
    if (way * (there - t) > 0) there = t;
    const auto rest = leave_to(there, trail, watch);
    if (watch.cancelled()) return false;
    if (rest && shell_->start(there, *rest, watch).end == Outcome::reached) {
      event.to = there;
      return true;
    }
    if (there == t) break;
    // the path stands where it was lost
    shell_->back_to(shell_->state());
    shell_->place(last.t, last.state);
  }
  return false;
}

Report Session::sample(double t, const Station& beside, bool unstable, const Watch& watch) {
  const double begin = seconds_now();
  const Effort before = effort();
  shell_->allow_unstable(unstable || !beside.certificate.stable());
  const NestedReport nested = shell_->sample(t, beside.point, watch);
  shell_->allow_unstable(false);
  return report(nested.end, nested.t, before, begin);
}

Report Session::sample_rest(double t, const Station& before, const Watch& watch) {
  const double begin = seconds_now();
  const Effort spent = effort();
  const auto rest = leave_branch(shell_->system(0), shell_->motion(0), before.point, t, watch);
  if (!rest) return report(Outcome::lost, t, spent, begin);
  return sample(t, {{t, *rest, {}}, {}}, false, watch);
}

Growth Session::steady_load() const {
  return {actuating_ ? load_scale_ * progress_ : load_scale_, 0};
}

void Session::settle_field(std::vector<NodeAction> field) {
  field_ = std::move(field);
  shell_->set_fields(field_, {});
}

/// Drives the shell from where it is, all the way if it can.
Report Session::drive(const Drive& drive, std::vector<NodeAction> coming, const Watch& watch) {
  const double begin = seconds_now();
  const Effort before = effort();
  const std::vector<Hold> held = drive.holds;
  shell_->set_fields(field_, coming);
  shell_->drive(drive);
  holds_ = held;
  actuating_ = false;
  first_stiffness_ = 0;
  const NestedReport started = shell_->start(0, shell_->state().levels[0], watch);
  if (started.end != Outcome::reached) return report(started.end, 0, before, begin);
  Report done = go(1, watch);
  std::vector<NodeAction> field = field_;
  const auto come = times(std::move(coming), drive.field.begin + done.t * drive.field.change);
  field.insert(field.end(), come.begin(), come.end());
  std::erase_if(field,
                [](const NodeAction& a) { return a.force.isZero(0) && a.stiffness.isZero(0); });
  settle_field(std::move(field));
  return done;
}

Report Session::move_to(double progress, const Watch& watch) {
  const double t = std::sqrt(std::max(progress, 0.0));
  if (!actuating_) {
    const double now = std::sqrt(progress_);
    shell_->actuate(now, holds_, load_scale_);
    actuating_ = true;
    const NestedReport started = shell_->start(now, shell_->state().levels[0], watch);
    if (started.end != Outcome::reached) return report(started.end, now, effort(), seconds_now());
  }
  return go(t, watch);
}

Report Session::rebase(const BoundaryMotion& motion, const Watch& watch) {
  const Growth load = steady_load();
  return drive({.holds = holds_, .displacements = {}, .boundary = motion, .load = load}, {}, watch);
}

Report Session::take_hold(std::vector<Hold> holds, std::vector<Eigen::Vector3d> displacements,
                          const Watch& watch) {
  const double begin = seconds_now();
  const Effort before = effort();
  const Growth load = steady_load();
  along_.resize(0);
  for (std::size_t k = 0; k < holds.size(); ++k) {
    const Eigen::VectorXd part = holds[k].directions.transpose() * displacements[k];
    along_.conservativeResize(along_.size() + part.size());
    along_.tail(part.size()) = part;
  }
  along_.normalize();
  shell_->drive({.holds = holds, .displacements = std::move(displacements), .load = load});
  holds_ = std::move(holds);
  actuating_ = false;
  const NestedReport nested = shell_->start(0, shell_->state().levels[0], watch);
  if (nested.end == Outcome::reached) first_stiffness_ = push_stiffness();
  return report(nested.end, nested.t, before, begin);
}

Report Session::push(int joint, const Eigen::Vector3d& displacement, Across across,
                     const Watch& watch) {
  std::vector<Hold> holds = holds_;
  std::erase_if(holds, [&](const Hold& hold) { return hold.node == joint; });
  Hold hold{joint};
  if (across == Across::free) hold.directions = displacement.normalized();
  holds.push_back(hold);
  std::vector<Eigen::Vector3d> displacements(holds.size(), Eigen::Vector3d::Zero());
  displacements.back() = displacement;
  const Report taken = take_hold(std::move(holds), std::move(displacements), watch);
  return taken.end == Outcome::reached ? go(1, watch) : taken;
}

Report Session::release(int joint, const Watch& watch) {
  std::vector<Hold> left = holds_;
  std::vector<NodeAction> force;
  for (std::size_t k = 0; k < holds_.size(); ++k)
    if (holds_[k].node == joint) force.push_back({joint, holds_[k].part(this->force(k))});
  std::erase_if(left, [&](const Hold& hold) { return hold.node == joint; });
  const Growth load = steady_load();
  const Checkpoint held = save();
  Report done = drive({.holds = left, .load = load, .field = {1, -1}}, std::move(force), watch);
  if (done.end == Outcome::reached || watch.cancelled()) return done;
  // held it was stable, under the same force it is not: the hand opens, and the shell goes to rest
  restore(held);
  shell_->drive({.holds = left, .load = load});
  holds_ = left;
  const auto found = rest_below(shell_->system(0), shell_->state().levels[0], watch);
  Outcome end = Outcome::not_converged;
  if (found) end = shell_->start(0, *found, watch).end;
  if (end != Outcome::reached) restore(held);
  done.certificate = certificate();
  done.end = watch.cancelled() ? Outcome::cancelled : end;
  return done;
}

Report Session::load(double factor, const Watch& watch) {
  const Growth now = steady_load();
  Report done = drive({.holds = holds_, .load = {now.begin, factor - now.begin}}, {}, watch);
  load_scale_ = now.begin + done.t * (factor - now.begin);
  return done;
}

Report Session::set_field(std::vector<NodeAction> field, const Watch& watch) {
  const Growth load = steady_load();
  const std::vector<NodeAction> coming = difference(field, field_);
  Report done = drive({.holds = holds_, .load = load, .field = {0, 1}}, coming, watch);
  if (done.end == Outcome::reached) settle_field(std::move(field));
  return done;
}

Report Session::rest(const Watch& watch) {
  const double begin = seconds_now();
  const Effort before = effort();
  const Checkpoint good = save();
  const double t = shell_->state().t;
  const auto found = rest_below(shell_->system(0), shell_->state().levels[0], watch);
  Outcome end = watch.cancelled() ? Outcome::cancelled : Outcome::not_converged;
  if (found) end = shell_->start(t, *found, watch).end;
  if (end != Outcome::reached) restore(good);
  return report(end, t, before, begin);
}

Report Session::rest_in_time(const Watch& watch,
                             const std::function<void(const MovingState&)>& seen) {
  const double begin = seconds_now();
  const Effort before = effort();
  const Checkpoint good = save();
  Linearisation& system = shell_->system(0);
  const auto mass = lumped_mass(system.model(), scene_->mass_t_per_mm);
  if (!mass) return report(Outcome::not_converged, shell_->state().t, before, begin);
  DynamicsOptions options;
  options.step_s = scene_->snap.step_s;
  options.damping_per_s = scene_->snap.damping_per_s;
  DampedMotion damped(system.model(), *mass, options, system.outside, holds_);
  MovingState moving = MovingState::at_rest(shell_->state().levels[0]);
  Outcome end = Outcome::not_converged;
  if (damped.settle(moving, {}, seen, watch)) {
    system.gradient_at(moving.state);
    moving.state.force = system.assembly().force;
    end = shell_->start(shell_->state().t, moving.state, watch).end;
  }
  if (watch.cancelled()) end = Outcome::cancelled;
  if (end != Outcome::reached) restore(good);
  return report(end, shell_->state().t, before, begin);
}

Result<Report> Session::set_rods(const ShellRods& rods, const Watch& watch) {
  const double begin = seconds_now();
  const Effort before = effort();
  std::optional<ShellRods> old = std::exchange(rods_, rods);
  const auto taken = take_over(shell_->plan(), true, watch);
  if (!taken || *taken != Outcome::reached) rods_ = std::move(old);
  if (!taken) return tl::unexpected<Error>(taken.error());
  return report(*taken, shell_->state().t, before, begin);
}

Report Session::refine(double tolerance_mm, const Watch& watch) {
  const double begin = seconds_now();
  const Effort before = effort();
  Outcome end = Outcome::reached;
  while (end == Outcome::reached && !(certificate().error_estimate_mm <= tolerance_mm)) {
    const auto plan = finer(shell_->plan());
    if (!plan) break;
    end = take_over(*plan, false, watch).value_or(Outcome::not_converged);
  }
  return report(end, shell_->state().t, before, begin);
}

// ---- keep ----

Checkpoint Session::save() const {
  Checkpoint kept{shell_->state(), shell_->plan(), rods_,     {},        holds_,
                  field_,          load_scale_,    progress_, actuating_};
  for (int k = 0; k < shell_->levels(); ++k) kept.motions.push_back(shell_->motion(k));
  return kept;
}

void Session::restore(const Checkpoint& kept) {
  if (kept.rods.has_value() != rods_.has_value() || rods_.has_value() ||
      kept.plan.edges_per_segment != shell_->plan().edges_per_segment) {
    rods_ = kept.rods;
    // it was built before, so it can be built again
    if (!build(kept.plan)) return;
  }
  holds_ = kept.holds;
  load_scale_ = kept.load_scale;
  progress_ = kept.progress;
  actuating_ = kept.actuating;
  settle_field(kept.field);
  shell_->restore(kept.state, kept.motions, kept.holds);
}

}  // namespace gridshell
