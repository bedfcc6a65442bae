// Where a branch ends: the event, the limit, and the equilibrium from which the path continues.
#include <algorithm>
#include <cmath>

#include "engine/simulate/branch_switch.h"
#include "engine/simulate/path_walk.h"

namespace gridshell {
namespace {

constexpr double located = 2.5e-4;       // prescribed displacement to which a limit is located, d
constexpr double fraction_of_loads = 4;  // change over the loads that counts as the length scale

}  // namespace

void Event::extrapolate(const Location& other) {
  const double times = double(location.edges) / other.edges;
  const double left = (location.t - other.t) / (times * times - 1);
  // a limit is that of the finest mesh, whose state is saved
  if (!is_limit()) t = location.t + left;
  error = std::abs(left) + location.located + other.located;
}

/// The branch ended between `good` and `next`. The path continues from another equilibrium, or
/// along unstable states if the scene has no imperfection, or it ends.
Outcome Simulation::Walk::branch_ended(Outcome how, double next, const NestedState& good) {
  const auto kind =
      how == Outcome::unstable ? Event::Kind::stability_lost : Event::Kind::turned_back;
  // a loss of stability that only the Hessian at the end of a step shows is not located yet
  if (shell_.followed().t == next && kind == Event::Kind::stability_lost)
    bisect(next, good, [] { return true; });
  else if (scene_.stops_at_contact || scene_.limits_strength())
    shell_.advance(shell_.followed().t, watch_);
  if (auto limit = of_.exceeded(limits_)) return end_before(std::move(*limit), now(), good);
  if (now() != good.t) record_step();
  const NestedState end_of_branch = shell_.state();
  Event event{.kind = kind, .t = shell_.followed().t, .error = {}, .to = {}};
  event.location = {shell_.plan().edges_per_segment.back(), event.t, located_to()};
  confirm(event);
  if (kind == Event::Kind::stability_lost && !scene_.imperfection.chooses()) {
    segment_.events.push_back(std::move(event));
    shell_.back_to(end_of_branch);
    shell_.allow_unstable(true);
    return Outcome::reached;
  }
  std::vector<TimedState> moments;
  if (!switch_branch(event, moments)) {
    segment_.events.push_back(std::move(event));
    return watch_.cancelled() ? Outcome::cancelled : how;
  }
  if (auto limit = of_.exceeded(limits_)) {
    // the new equilibrium exceeds a limit: the path ends before the snap
    shell_.back_to(end_of_branch);
    if (limit->kind == Event::Kind::locked) limit->what = "past a snap";
    return end_before(std::move(*limit), event.t, end_of_branch);
  }
  if (record_ && !moments.empty())
    record_->snaps.push_back({record_->load_steps.size() - 1, std::move(moments)});
  segment_.events.push_back(std::move(event));
  segment_.unmeasured_since.reset();
  segment_.companion.reset();
  segment_.lowest_stiffness.clear();
  accept();
  return Outcome::reached;
}

void Simulation::Walk::store_companion() {
  const int companion = shell_.last() - 1;
  if (companion >= 0 && shell_.state().measured <= companion)
    segment_.companion = TimedState{now(), shell_.state().levels[std::size_t(companion)]};
}

/// Searches for an event of the path on the coarser mesh, from that mesh's last state before it.
/// The path's state does not change, except for the loads.
void Simulation::Walk::confirm(Event& event) {
  const int companion = shell_.last() - 1;
  if (companion < 0) return;
  store_companion();
  event.confirmed = false;
  if (!segment_.companion) return;
  constexpr double found_to = 5e-5;  // accuracy in the path parameter
  // the last step that was too long may be nearly twice the smallest
  PathFollower path(shell_.system(companion), shell_.motion(companion),
                    {.spacing_mm = scene_.footprint.spacing, .smallest_step = found_to / 2});
  if (path.start(segment_.companion->time, segment_.companion->state, watch_).end !=
      Outcome::reached)
    return;
  const double past = event.t + std::copysign(shell_.plan().events_apart, to_ - event.t);
  if (path.advance(past, watch_).end == Outcome::reached) return;
  event.confirmed = true;
  const auto& edges = shell_.plan().edges_per_segment;
  event.extrapolate({edges[std::size_t(companion)], path.point().t, found_to});
}

/// By how much the path parameter changes while the boundary moves by the length scale or, if that
/// is sooner, the loads change by four times their size.
double Simulation::Walk::parameter_scale(double t) const {
  const PinnedMotion& motion = shell_.motion();
  const double speed = motion.speed(t);
  // a joint actuation counts by its complete angle
  if (motion.opening.change != 0) return 1;
  const double boundary = scene_.length_scale_mm / std::max(shell_.reach_mm() * speed, 0.1);
  const double rate = std::abs(speed * motion.load.change);
  if (rate == 0 || shell_.model().loads.empty()) return boundary;
  return std::min(boundary, fraction_of_loads * std::abs(motion.factor_at(motion.load, t)) / rate);
}

/// Searches for the equilibrium at `there`, past the event, from which the path continues. The path
/// is then in that equilibrium or, if there is none, where the branch ended.
bool Simulation::Walk::switch_branch_to(double there, const PathPoint& last, Event& event,
                                        std::vector<TimedState>& moments) {
  moments.clear();
  const auto rest =
      rest_after_bifurcation(shell_, scene_, last, event.kind, there, moments, watch_);
  if (watch_.cancelled()) return false;
  if (rest && shell_.start(there, *rest, watch_).end == Outcome::reached) {
    event.to = there;
    event.jump = event.kind != Event::Kind::stability_lost ||
                 !on_branch_from(shell_, scene_, last, there, *rest, watch_);
    shell_.apply_loads();
    return true;
  }
  shell_.back_to(shell_.state());
  shell_.start_path(last.t, last.state);
  return false;
}

/// Whether the current state, past a loss of stability, is on the branch that lost it and has
/// regained it. Between the two the shell is on another branch.
bool Simulation::Walk::skipped_a_branch(const PathPoint& last) {
  constexpr double same_state = 1e-3;  // in units of d
  PathFollower path(shell_.system(), shell_.motion(),
                    {.spacing_mm = scene_.footprint.spacing, .allow_unstable = true});
  const State& found = shell_.state().levels.back();
  if (path.start(last.t, last.state, watch_).end != Outcome::reached) return false;
  if (path.advance(now(), watch_).end != Outcome::reached) return false;
  return max_column_norm((path.point().state.x - found.x).leftCols(shell_.model().nodes)) <
         same_state * scene_.footprint.spacing;
}

/// Searches for the equilibrium after the end of a branch, first next to the event, then at larger
/// distances. If it is on the branch that had ended, the search continues nearer to the event.
bool Simulation::Walk::switch_branch(Event& event, std::vector<TimedState>& moments) {
  const PathPoint last = shell_.followed();
  const double sign = to_ > last.t ? 1 : -1;
  const auto at = [&](double scales) {
    const double there = last.t + sign * scales * parameter_scale(last.t);
    return sign * (there - to_) > 0 ? to_ : there;
  };
  constexpr double nearest = 1e-3, farthest = 0.1, nearest_by_far = 1e-5;  // in scales
  bool found = false;
  for (double distance = nearest; !found && distance < farthest && !watch_.cancelled();
       distance *= 2) {
    found = switch_branch_to(at(distance), last, event, moments);
    if (at(distance) == to_) break;
  }
  if (!found || event.kind != Event::Kind::stability_lost || scene_.snap.requested ||
      !skipped_a_branch(last))
    return found;
  const NestedState far = shell_.state();
  const Event to_far = event;
  for (double distance = nearest / 2; distance > nearest_by_far; distance /= 2) {
    shell_.back_to(far);
    shell_.start_path(last.t, last.state);
    if (switch_branch_to(at(distance), last, event, moments) && !skipped_a_branch(last))
      return true;
    if (watch_.cancelled()) return false;
  }
  shell_.back_to(far);
  shell_.apply_loads();
  event = to_far;
  moments.clear();
  return true;
}

// ---- limits ----

/// The error, in the path parameter, to which a limit is located. The second bound is for loads
/// that change without a prescribed displacement.
double Simulation::Walk::located_to() const {
  constexpr double of_loads = 1e-3;
  return std::min(located * scene_.footprint.spacing / std::max(shell_.reach_mm(), 1e-9), of_loads);
}

Outcome Simulation::Walk::end_at(Event limit) {
  limit.t = now();
  limit.location = {shell_.plan().edges_per_segment.back(), limit.t};
  segment_.events.push_back(std::move(limit));
  return outcome_of(segment_.events.back().kind);
}

/// Ends in the last state between `good` and `bad` that exceeds no limit.
Outcome Simulation::Walk::end_before(Event limit, double bad, const NestedState& good) {
  bisect(bad, good, [&] {
    auto met = of_.exceeded(limits_);
    if (met) limit = std::move(*met);
    return !met;
  });
  if (limit.kind != Event::Kind::locked) {
    // the error of a single mesh is not known
    if (shell_.levels() > 1) limit.error = located_to();
    if (now() != good.t) record_step();
  }
  return end_at(std::move(limit));
}

/// Moves to the last certified state between `good` and `bad` that is accepted.
void Simulation::Walk::bisect(double bad, const NestedState& good,
                              const std::function<bool()>& accepted) {
  NestedState last = good;
  while (std::abs(bad - last.t) > located_to() && !watch_.cancelled()) {
    shell_.back_to(last);
    const double middle = 0.5 * (last.t + bad);
    if (shell_.advance(middle, watch_).end == Outcome::reached && accepted())
      last = shell_.state();
    else
      bad = middle;
  }
  shell_.back_to(last);
}

Report Simulation::certify_rest_at(double t, const LoadStep& before, const Watch& watch) {
  const CallBegin begin = call_begin();
  std::vector<TimedState> moments;
  const auto rest = rest_after_bifurcation(*shell_, *scene_, before.point,
                                           Event::Kind::stability_lost, t, moments, watch);
  if (!rest) return report(Outcome::lost, t, begin);
  return sample(t, {{{t, *rest, {}}}, {}}, false, watch);
}

}  // namespace gridshell
