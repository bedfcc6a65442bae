// How a simulation follows its path, and how it steps where its shell grows soft.

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/file_io.h"
#include "engine/core/system_info.h"
#include "engine/core/watch.h"
#include "engine/elastic/model.h"
#include "engine/simulate/branch_switch.h"
#include "engine/simulate/frames.h"
#include "engine/simulate/kept_segments.h"
#include "engine/simulate/simulation.h"
#include "engine/solve/nested_shell.h"
#include "engine/solve/newton.h"

namespace gridshell {

void Event::extrapolate(const Location& other) {
  const double times = double(placed.edges) / other.edges;
  const double left = (placed.t - other.t) / (times * times - 1);
  // the finest mesh decides about a limit, and the saved state is that mesh's
  if (!is_limit()) t = placed.t + left;
  error = std::abs(left) + placed.located + other.located;
}

/// Follows the stiffness of the lowest mode from load step to load step. A
/// branch may lose its stability and regain it within one step, and the shell would have left it
/// in between: where the stiffness heads for zero, steps become short enough to see that.
class StabilityStepControl {
 public:
  /// After a load step that was certified.
  void take(const NestedState& state);
  /// Clears the history of the path, which continues from another state.
  void forget() { known_.clear(); }
  /// The load step to take instead of `step`, at least an eighth of it.
  double shortened(double step) const;
  /// The history, for a path that continues later.
  const std::vector<simulate::Softness>& known() const { return known_; }
  void know(std::vector<simulate::Softness> known) { known_ = std::move(known); }

 private:
  std::vector<simulate::Softness> known_;  // at the last two load steps
};

void StabilityStepControl::take(const NestedState& state) {
  if (known_.size() > 1) known_.erase(known_.begin());
  known_.push_back({state.t, state.lowest_eigenvalue});
}

double StabilityStepControl::shortened(double step) const {
  if (known_.size() < 2) return step;
  const auto &before = known_[0], &now = known_[1];
  const double fall = (before.stiffness - now.stiffness) / std::abs(now.t - before.t);
  // also where a stiffness is not known
  if (!(fall > 0)) return step;
  const double to_zero = now.stiffness / fall;
  return to_zero < 3 * step ? std::clamp(to_zero / 3, step / 8, step) : step;
}

namespace {

constexpr double push_step = 0.02;       // of the length scale: the largest load step
constexpr double actuation_step = 0.05;  // in the path parameter
constexpr double locate_mm = 5e-3;       // of prescribed move: to which a limit is located
constexpr double loads_ways = 4;         // of the loads, what counts as the length scale of a move
// branches left on one path; rods in contact slip past each other repeatedly
constexpr std::size_t most_events = 8, most_events_in_contact = 64;

}  // namespace

double Simulation::load_step() const {
  if (actuating_) return scene_->load_step * actuation_step;
  const double reach = shell_->reach_mm();
  return scene_->load_step * (reach > 0 ? push_step * scene_->length_scale_mm / reach : 0.1);
}

/// One segment of the path: how it steps, what it leaves, what ends it.
class Simulation::Walk {
 public:
  Walk(Simulation& of, double to, const BifurcationPolicy& leaving, PathRecord* record,
       const Watch& watch)
      : of_(of), to_(to), leaving_(leaving), record_(record), watch_(watch) {}

  Report all();

 private:
  double now() const { return shell_.state().t; }
  void note();
  void tell() const;
  void keep();
  bool goes_on();
  bool watches_stability() const {
    return record_ && of_.actuating_ && leaving_.requested && scene_.imperfection.chooses();
  }
  void keep_segment(std::optional<Outcome> end);
  Outcome step();
  Outcome step_came(double next, const NestedState& good);
  Outcome branch_ended(Outcome how, double next, const NestedState& good);
  Outcome end_at(Event limit);
  Outcome end_before(Event limit, double bad, const NestedState& good);
  bool too_coarse();
  double located_to() const;
  double parameter_scale(double t) const;
  void bisect(double bad, const NestedState& good, const std::function<bool()>& accepted);
  bool leave(Event& event, std::vector<TimedState>& moments);
  void confirm(Event& event);
  void keep_companion();

  Simulation& of_;
  NestedShell& shell_ = *of_.shell_;
  const Scene& scene_ = *of_.scene_;
  double to_;
  BifurcationPolicy leaving_;
  PathRecord* record_;
  const Watch& watch_;
  // a state that starts past a limit may return, and goes no further past it
  Limits limits_ = of_.limits_here();
  bool from_beyond_ = of_.beyond_limits().has_value();
  StabilityStepControl softening_;
  std::vector<Event> events_;
  std::optional<double> unmeasured_since_;  // path parameter: no companion has a state since
  std::optional<TimedState> companion_;     // its last state on this branch; time: path parameter
  // of a saved segment, as it was after the last step
  simulate::KeptSegments* kept_ = record_ ? scene_.kept.get() : nullptr;
  simulate::KeptSegment segment_;
  Effort effort_before_;
};

Report Simulation::go(double t, const Watch& watch, const BifurcationPolicy& leaving,
                      PathRecord* record) {
  return Walk(*this, t, leaving, record, watch).all();
}

Report Simulation::Walk::all() {
  const CallBegin begin = of_.call_begin();
  shell_.allow_unstable(leaving_.through_unstable);
  shell_.watch_stability(watches_stability());
  Outcome end = Outcome::reached;
  if (goes_on()) {
    end = segment_.end.value_or(end);
  } else {
    keep();
    keep_segment({});
    if (too_coarse()) end = Outcome::too_coarse;
  }
  while (end == Outcome::reached && now() != to_) {
    end = step();
    if (end == Outcome::reached) keep_segment({});
  }
  if (end != Outcome::cancelled) keep_segment(end);
  shell_.allow_unstable(false);
  shell_.watch_stability(false);
  // the path may be ahead of what is certified
  if (end != Outcome::reached && !at_limit(end)) shell_.back_to(shell_.state());
  Report done = of_.report(end, now(), begin);
  done.events = std::move(events_);
  if (of_.actuating_) of_.set_progress(progress_at(done.t));
  return done;
}

void Simulation::Walk::note() {
  if (record_) record_->load_steps.push_back({shell_.point(), of_.certificate(), of_.contacts()});
}

/// Reports the path parameter to the observer.
void Simulation::Walk::tell() const {
  if (&watch_ != &unwatched) watch_.stand_at(now(), shell_.plan().edges_per_segment.back());
}

/// Notes a load step from which the path continues.
void Simulation::Walk::keep() {
  note();
  tell();
  keep_companion();
  if (watches_stability()) softening_.take(shell_.state());
}

// ---- what an earlier run kept of it ----

/// Whether an earlier run saved this segment or its start; the shell then has the state saved
/// there.
bool Simulation::Walk::goes_on() {
  if (!kept_) return false;
  segment_.begin = {Checksum::of({reinterpret_cast<const char*>(shell_.state().x.data()),
                                  sizeof(double) * std::size_t(shell_.state().x.size())}),
                    now(), to_, shell_.plan().edges_per_segment};
  effort_before_ = of_.effort();
  auto before = kept_->next(segment_.begin);
  if (!before) return false;
  segment_ = std::move(*before);
  of_.charge(segment_.effort);
  static_cast<PathRecord&>(*record_) = std::move(segment_.record);
  events_ = segment_.events;
  softening_.know(segment_.softening);
  const bool stays = std::ranges::any_of(events_, [](const Event& event) {
    return event.kind == Event::Kind::stability_lost && !event.to;
  });
  shell_.allow_unstable(leaving_.through_unstable || stays);
  shell_.back_to(segment_.state);
  tell();
  return true;
}

/// Saves the segment if enough time was spent since the last save; the result of a cancelled step
/// is not saved.
void Simulation::Walk::keep_segment(std::optional<Outcome> end) {
  if (!kept_ || !kept_->wants(end.has_value())) return;
  segment_.end = end;
  segment_.state = shell_.state();
  segment_.events = events_;
  segment_.effort = of_.effort() - effort_before_;
  segment_.softening = softening_.known();
  // lent, as it may be large
  std::swap<PathRecord>(segment_.record, *record_);
  kept_->keep(segment_);
  std::swap<PathRecord>(segment_.record, *record_);
}

// ---- how it steps ----

Outcome Simulation::Walk::step() {
  if (watch_.cancelled()) return Outcome::cancelled;
  const double left = to_ - now(), longest = softening_.shortened(of_.load_step());
  // where the path itself needs short steps, its load steps are no much longer ones
  const double step = std::clamp(shell_.state().step, longest / 8, longest);
  const int steps = std::max(1, int(std::ceil(std::abs(left) / step - 1e-9)));
  const double next = steps == 1 ? to_ : now() + left / steps;
  const NestedState good = shell_.state();
  const Outcome end = shell_.advance(next, watch_).end;
  if (end == Outcome::reached) return step_came(next, good);
  const bool ended = end == Outcome::unstable || end == Outcome::lost;
  const std::size_t most = shell_.model().contact.any() ? most_events_in_contact : most_events;
  if (!ended || !leaving_.requested || events_.size() >= most) return end;
  return branch_ended(end, next, good);
}

Outcome Simulation::Walk::step_came(double next, const NestedState& good) {
  if (auto limit = of_.beyond(limits_)) return end_before(std::move(*limit), next, good);
  if (from_beyond_ && !of_.beyond_limits()) {
    limits_ = of_.limits();
    from_beyond_ = false;
  }
  keep();
  return too_coarse() ? Outcome::too_coarse : Outcome::reached;
}

/// Whether the path need not be followed further on this mesh: its error estimate is above the
/// allowed one, or no coarser mesh has had a state for longer than two meshes' events may differ.
bool Simulation::Walk::too_coarse() {
  const LevelPlan& plan = shell_.plan();
  if (!std::isfinite(plan.allowed_mm) || !of_.certificate().stable()) return false;
  if (shell_.state().measured < shell_.last()) {
    unmeasured_since_.reset();
    return of_.certificate().error_estimate_mm > plan.allowed_mm;
  }
  if (!unmeasured_since_) unmeasured_since_ = now();
  return std::abs(now() - *unmeasured_since_) > plan.events_apart;
}

/// The branch ended between `good` and `next`: continues from the next equilibrium, along the
/// states that are not stable, or not at all.
Outcome Simulation::Walk::branch_ended(Outcome how, double next, const NestedState& good) {
  const auto kind =
      how == Outcome::unstable ? Event::Kind::stability_lost : Event::Kind::turned_back;
  // what is lost by the Hessian at the end of a step alone is not located yet, nor is a limit
  if (shell_.followed().t == next && kind == Event::Kind::stability_lost)
    bisect(next, good, [] { return true; });
  else if (scene_.stops_at_contact || scene_.limits_strength())
    shell_.advance(shell_.followed().t, watch_);
  if (auto limit = of_.beyond(limits_)) return end_before(std::move(*limit), now(), good);
  if (now() != good.t) note();
  const NestedState end_of_branch = shell_.state();
  Event event{.kind = kind, .t = shell_.followed().t, .error = {}, .to = {}};
  event.placed = {shell_.plan().edges_per_segment.back(), event.t, located_to()};
  confirm(event);
  if (kind == Event::Kind::stability_lost && !scene_.imperfection.chooses()) {
    events_.push_back(std::move(event));
    shell_.back_to(end_of_branch);
    shell_.allow_unstable(true);
    return Outcome::reached;
  }
  std::vector<TimedState> moments;
  if (!leave(event, moments)) {
    events_.push_back(std::move(event));
    return watch_.cancelled() ? Outcome::cancelled : how;
  }
  if (auto limit = of_.beyond(limits_)) {
    // the state past it would need longer or thinner rods, or room where others are
    shell_.back_to(end_of_branch);
    if (limit->kind == Event::Kind::locked) limit->what = "past a snap";
    return end_before(std::move(*limit), event.t, end_of_branch);
  }
  if (record_ && !moments.empty())
    record_->snaps.push_back({record_->load_steps.size() - 1, std::move(moments)});
  events_.push_back(std::move(event));
  unmeasured_since_.reset();
  companion_.reset();
  softening_.forget();
  keep();
  return Outcome::reached;
}

void Simulation::Walk::keep_companion() {
  const int companion = shell_.last() - 1;
  if (companion >= 0 && shell_.state().measured <= companion)
    companion_ = TimedState{now(), shell_.state().levels[std::size_t(companion)]};
}

/// Searches for an event of the path on the coarser mesh, from its last state before it. The path
/// returns to its state, except for the loads.
void Simulation::Walk::confirm(Event& event) {
  const int companion = shell_.last() - 1;
  if (companion < 0) return;
  keep_companion();
  event.confirmed = false;
  if (!companion_) return;
  constexpr double found_to = 5e-5;  // in the path parameter
  PathOptions options;
  options.spacing_mm = scene_.footprint.spacing;
  // the last step that was too long may be nearly twice the smallest
  options.smallest_step = found_to / 2;
  PathFollower path(shell_.system(companion), shell_.motion(companion), options);
  if (path.start(companion_->time, companion_->state, watch_).end != Outcome::reached) return;
  const double past = event.t + std::copysign(shell_.plan().events_apart, to_ - event.t);
  if (path.advance(past, watch_).end == Outcome::reached) return;
  event.confirmed = true;
  const auto& edges = shell_.plan().edges_per_segment;
  event.extrapolate({edges[std::size_t(companion)], path.point().t, found_to});
}

/// By how much the path parameter changes while the boundary moves by the length scale, or, where
/// that is sooner, the loads by what they are.
double Simulation::Walk::parameter_scale(double t) const {
  const PinnedMotion& motion = shell_.motion();
  const double speed = motion.speed(t);
  // a joint actuation counts by its complete angle
  if (motion.opening.change != 0) return 1;
  const double boundary = scene_.length_scale_mm / std::max(shell_.reach_mm() * speed, 0.1);
  const double rate = std::abs(speed * motion.load.change);
  if (rate == 0 || shell_.model().loads.empty()) return boundary;
  return std::min(boundary, loads_ways * std::abs(motion.factor_at(motion.load, t)) / rate);
}

/// The branch ended: the next equilibrium a little further on, where it is far enough from the
/// event to be found.
bool Simulation::Walk::leave(Event& event, std::vector<TimedState>& moments) {
  const PathPoint last = shell_.followed();
  const double way = to_ > last.t ? 1 : -1;
  for (double beyond = 1e-3; beyond < 0.1; beyond *= 2) {
    double there = last.t + way * beyond * parameter_scale(last.t);
    if (way * (there - to_) > 0) there = to_;
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
    if (there == to_) break;
    // the path is at the state where it was lost
    shell_.back_to(shell_.state());
    shell_.place(last.t, last.state);
  }
  return false;
}

// ---- what ends it ----

/// To how much in the path parameter a limit is located; where loads alone change nothing is moved.
double Simulation::Walk::located_to() const {
  constexpr double of_loads = 1e-3;
  return std::min(locate_mm / std::max(shell_.reach_mm(), 1e-9), of_loads);
}

Outcome Simulation::Walk::end_at(Event limit) {
  limit.t = now();
  limit.placed = {shell_.plan().edges_per_segment.back(), limit.t};
  events_.push_back(std::move(limit));
  return outcome_of(events_.back().kind);
}

/// Ends in the last state between `good` and `bad` that exceeds no limit.
Outcome Simulation::Walk::end_before(Event limit, double bad, const NestedState& good) {
  bisect(bad, good, [&] {
    auto met = of_.beyond(limits_);
    if (met) limit = std::move(*met);
    return !met;
  });
  if (limit.kind != Event::Kind::locked) {
    // the error of a single mesh is not known
    if (shell_.levels() > 1) limit.error = located_to();
    if (now() != good.t) note();
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

Report Simulation::sample(double t, const LoadStep& beside, bool unstable, const Watch& watch,
                          const LoadStep* across) {
  const CallBegin begin = call_begin();
  shell_->allow_unstable(unstable || !beside.certificate.stable());
  const NestedReport nested =
      shell_->sample(t, beside.point, watch, across ? &across->point : nullptr);
  shell_->allow_unstable(false);
  return report(nested.end, nested.t, begin);
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
