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

/// Follows the stiffness of the softest mode on the leading mesh from load step to load step. A
/// branch may lose its stability and regain it within one step, and the shell would have left it
/// in between: where the stiffness heads for zero, steps become short enough to see that.
class StabilityStepControl {
 public:
  /// After a load step that was certified.
  void take(NestedShell& shell, const Watch& watch);
  /// Nothing is known of the path: it goes on from somewhere else.
  void forget() { known_.clear(); }
  /// The load step to take in the place of `step`, at least an eighth of it.
  double shortened(double step) const;
  /// What it knows, for a way that goes on later.
  const std::vector<simulate::Softness>& known() const { return known_; }
  void know(std::vector<simulate::Softness> known) { known_ = std::move(known); }

 private:
  std::vector<simulate::Softness> known_;  // at the last two load steps
};

void StabilityStepControl::take(NestedShell& shell, const Watch& watch) {
  constexpr double roughly = 0.02;  // the trend is enough
  const Eigen::VectorXd alike = Eigen::VectorXd::Ones(shell.model(0).nodes);
  if (known_.size() > 1) known_.erase(known_.begin());
  known_.push_back({shell.state().t, lowest_eigenvalue(shell.system(0), shell.state().levels[0],
                                                       alike, watch, roughly)});
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
constexpr int most_halvings = 5;         // of a load step that a finer mesh does not follow
constexpr double loads_ways = 4;         // of the loads, what counts as the length scale of a move
// branches left on one way; where rods press on one another they slip past each other again and
// again
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
  void keep_segment(std::optional<Outcome> end);
  Outcome step();
  Outcome step_came(double next, const NestedState& good);
  Outcome branch_ended(Outcome how, double next, const NestedState& good);
  Outcome end_at(Event limit);
  Outcome end_before(Event limit, double bad, const NestedState& good);
  double located_to() const;
  double parameter_scale(double t) const;
  void bisect(double bad, const NestedState& good, const std::function<bool()>& accepted);
  bool leave(Event& event);
  bool finest_goes_on();

  Simulation& of_;
  NestedShell& shell_ = *of_.shell_;
  const Scene& scene_ = *of_.scene_;
  double to_;
  BifurcationPolicy leaving_;
  PathRecord* record_;
  const Watch& watch_;
  // a state that begins beyond a limit may come back, and goes no further beyond it
  Limits limits_ = of_.limits_here();
  bool from_beyond_ = of_.beyond_limits().has_value();
  StabilityStepControl softening_;
  int halvings_ = 0;
  std::vector<Event> events_;
  // of a segment that is kept, as it was after the last step
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
  Outcome end = Outcome::reached;
  if (goes_on()) {
    end = segment_.end.value_or(end);
  } else {
    keep();
    keep_segment({});
  }
  while (end == Outcome::reached && now() != to_) {
    end = step();
    if (end == Outcome::reached) keep_segment({});
  }
  if (end != Outcome::cancelled) keep_segment(end);
  shell_.allow_unstable(false);
  // the leader may stand ahead of what is certified
  if (end != Outcome::reached && !at_limit(end)) shell_.back_to(shell_.state());
  Report done = of_.report(end, now(), begin);
  done.events = std::move(events_);
  if (of_.actuating_) of_.set_progress(progress_at(done.t));
  return done;
}

void Simulation::Walk::note() {
  if (record_) record_->load_steps.push_back({shell_.point(), of_.certificate(), of_.contacts()});
}

/// Tells who watches where the path stands.
void Simulation::Walk::tell() const {
  if (&watch_ != &unwatched) watch_.stand_at(now(), shell_.plan().edges_per_segment.front());
}

/// Notes a load step from which the path goes on.
void Simulation::Walk::keep() {
  note();
  tell();
  if (record_ && of_.actuating_ && leaving_.wanted && scene_.imperfection.chooses())
    softening_.take(shell_, watch_);
}

// ---- what an earlier run kept of it ----

/// Whether an earlier run followed this segment, or the begin of it: the shell then stands where
/// that one stood.
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
  halvings_ = segment_.halvings;
  softening_.know(segment_.softening);
  const bool stays = std::ranges::any_of(events_, [](const Event& event) {
    return event.kind == Event::Kind::stability_lost && !event.to;
  });
  shell_.allow_unstable(leaving_.through_unstable || stays);
  shell_.back_to(segment_.state);
  tell();
  return true;
}

/// Writes where the segment stands, as often as that is worth it; what a step that is stopped did
/// is none of it.
void Simulation::Walk::keep_segment(std::optional<Outcome> end) {
  if (!kept_ || !kept_->wants(end.has_value())) return;
  segment_.end = end;
  segment_.state = shell_.state();
  segment_.events = events_;
  segment_.effort = of_.effort() - effort_before_;
  segment_.halvings = halvings_;
  segment_.softening = softening_.known();
  // lent, as it may be large
  std::swap<PathRecord>(segment_.record, *record_);
  kept_->keep(segment_);
  std::swap<PathRecord>(segment_.record, *record_);
}

// ---- how it steps ----

Outcome Simulation::Walk::step() {
  if (watch_.cancelled()) return Outcome::cancelled;
  const double left = to_ - now();
  const double step = softening_.shortened(of_.load_step()) / (1 << halvings_);
  const int steps = std::max(1, int(std::ceil(std::abs(left) / step - 1e-9)));
  const double next = steps == 1 ? to_ : now() + left / steps;
  const NestedState good = shell_.state();
  const Outcome end = shell_.advance(next, watch_).end;
  if (end == Outcome::reached) return step_came(next, good);
  // a finer mesh that did not follow is asked again nearer by
  if (end == Outcome::meshes_disagree && ++halvings_ <= most_halvings) {
    shell_.back_to(good);
    return Outcome::reached;
  }
  // what it finds beside a leader that it followed with trouble alone is another state
  const bool led = shell_.followed().t == next;
  if (end == Outcome::unstable && led && halvings_ >= most_halvings)
    return Outcome::meshes_disagree;
  const bool ended = end == Outcome::unstable || end == Outcome::lost;
  const std::size_t most = shell_.model(0).contact.any() ? most_events_in_contact : most_events;
  if (!ended || !leaving_.wanted || events_.size() >= most) return end;
  return branch_ended(end, next, good);
}

Outcome Simulation::Walk::step_came(double next, const NestedState& good) {
  if (auto limit = of_.beyond(limits_)) return end_before(std::move(*limit), next, good);
  if (from_beyond_ && !of_.beyond_limits()) {
    limits_ = of_.limits();
    from_beyond_ = false;
  }
  halvings_ = std::max(halvings_ - 1, 0);
  keep();
  return Outcome::reached;
}

/// The branch ended between `good` and `next`: goes on from the next rest, along the states that
/// are not stable, or not at all.
Outcome Simulation::Walk::branch_ended(Outcome how, double next, const NestedState& good) {
  const auto kind =
      how == Outcome::unstable ? Event::Kind::stability_lost : Event::Kind::turned_back;
  const double last = shell_.followed().t;
  // what the finer meshes lost and the leader did not is not located yet
  const bool ahead = last == next && kind == Event::Kind::stability_lost;
  // nor is a limit that was asked for
  const bool asked = scene_.stops_at_contact || scene_.limits_strength();
  bool on_finest = ahead;
  if (ahead || asked) {
    on_finest = ahead || shell_.advance(last, watch_).end != Outcome::reached;
    if (on_finest) bisect(next, good, [] { return true; });
    if (auto limit = asked ? of_.beyond(limits_) : std::nullopt)
      return end_before(std::move(*limit), now(), good);
    if (now() != good.t) note();
  }
  const NestedState end_of_branch = shell_.state();
  const double t = shell_.followed().t;
  const std::vector<int>& edges = shell_.plan().edges_per_segment;
  events_.push_back({.kind = kind, .t = t, .error = {}, .to = {}});
  events_.back().placed =
      on_finest ? Event::Place{edges.back(), t, located_to()} : Event::Place{edges.front(), t};
  if (shell_.plan().finest_decides && !on_finest && finest_goes_on()) return how;
  if (kind == Event::Kind::stability_lost && !scene_.imperfection.chooses()) {
    shell_.back_to(end_of_branch);
    shell_.allow_unstable(true);
    return Outcome::reached;
  }
  if (!leave(events_.back())) return watch_.cancelled() ? Outcome::cancelled : how;
  if (auto limit = of_.beyond(limits_)) {
    // the rest beyond would need longer or thinner rods, or room where others are
    shell_.back_to(end_of_branch);
    events_.pop_back();
    // its frames in time go with it: no load step is where it landed
    if (record_ && !record_->snaps.empty() &&
        record_->snaps.back().before + 1 >= record_->load_steps.size())
      record_->snaps.pop_back();
    if (limit->kind == Event::Kind::locked) limit->what = "beyond a snap";
    return end_before(std::move(*limit), t, end_of_branch);
  }
  softening_.forget();
  keep();
  return Outcome::reached;
}

/// Whether the finest mesh, led by itself, comes clearly past the place where the leader lost the
/// branch.
bool Simulation::Walk::finest_goes_on() {
  constexpr double clearly = 0.05;  // in the path parameter
  const int finest = shell_.levels() - 1;
  if (finest == 0) return false;
  const NestedState here = shell_.state();
  const PathPoint lost = shell_.followed();
  const double past = lost.t + (to_ > lost.t ? clearly : -clearly);
  PathOptions options;
  options.spacing_mm = scene_.footprint.spacing;
  PathFollower path(shell_.system(finest), shell_.motion(finest), options);
  const bool goes_on =
      path.start(here.t, here.levels[std::size_t(finest)], watch_).end == Outcome::reached &&
      path.advance(to_ > lost.t ? std::min(past, to_) : std::max(past, to_), watch_).end ==
          Outcome::reached;
  // the path stands where it was lost
  shell_.back_to(here);
  shell_.place(lost.t, lost.state);
  return goes_on;
}

/// By how much the path parameter changes while the boundary moves by the length scale, or, where
/// that is sooner, the loads by what they are.
double Simulation::Walk::parameter_scale(double t) const {
  const PinnedMotion& motion = shell_.motion(0);
  const double speed = motion.speed(t);
  // joints that are opened count by the whole way that they are to open
  if (motion.opening.change != 0) return 1;
  const double boundary = scene_.length_scale_mm / std::max(shell_.reach_mm() * speed, 0.1);
  const double rate = std::abs(speed * motion.load.change);
  if (rate == 0 || shell_.model(0).loads.empty()) return boundary;
  return std::min(boundary, loads_ways * std::abs(motion.factor_at(motion.load, t)) / rate);
}

/// The branch ended: comes to rest again a little further on. The meshes lose it at slightly
/// different places; beyond the last of them all find the new state.
bool Simulation::Walk::leave(Event& event) {
  const PathPoint last = shell_.followed();
  const double way = to_ > last.t ? 1 : -1;
  for (double beyond = 1e-3; beyond < 0.1; beyond *= 2) {
    double there = last.t + way * beyond * parameter_scale(last.t);
    if (way * (there - to_) > 0) there = to_;
    std::vector<TimedState> moments;
    const auto rest =
        rest_after_bifurcation(shell_, scene_, last, event.kind, there, moments, watch_);
    if (watch_.cancelled()) return false;
    if (rest && shell_.start(there, *rest, watch_).end == Outcome::reached) {
      event.to = there;
      event.leap = event.kind != Event::Kind::stability_lost ||
                   !on_branch_from(shell_, scene_, last, there, *rest, watch_);
      shell_.apply_loads();
      if (record_ && !moments.empty())
        record_->snaps.push_back({record_->load_steps.size() - 1, std::move(moments)});
      return true;
    }
    if (there == to_) break;
    // the path stands where it was lost
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

/// Ends in the last state between `good` and `bad` that is not beyond a limit.
Outcome Simulation::Walk::end_before(Event limit, double bad, const NestedState& good) {
  bisect(bad, good, [&] {
    auto met = of_.beyond(limits_);
    if (met) limit = std::move(*met);
    return !met;
  });
  if (limit.kind != Event::Kind::locked) {
    // of one mesh alone its own error is not known
    if (shell_.levels() > 1) limit.error = located_to();
    if (now() != good.t) note();
  }
  return end_at(std::move(limit));
}

/// Stands in the last certified state, between `good` and `bad`, that is accepted.
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
