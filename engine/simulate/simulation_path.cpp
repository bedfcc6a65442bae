// How a path steps where its shell grows soft.

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/system_info.h"
#include "engine/core/watch.h"
#include "engine/simulate/branch_switch.h"
#include "engine/simulate/frames.h"
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
  void forget() { before_.reset(), now_.reset(); }
  /// The load step to take in the place of `step`, at least an eighth of it.
  double shortened(double step) const;

 private:
  struct Point {
    double t, stiffness;
  };
  std::optional<Point> before_, now_;
};

void StabilityStepControl::take(NestedShell& shell, const Watch& watch) {
  constexpr double roughly = 0.02;  // the trend is enough
  const Eigen::VectorXd alike = Eigen::VectorXd::Ones(shell.model(0).nodes);
  before_ = now_;
  now_ = Point{shell.state().t,
               lowest_eigenvalue(shell.system(0), shell.state().levels[0], alike, watch, roughly)};
}

double StabilityStepControl::shortened(double step) const {
  if (!before_ || !now_) return step;
  const double fall = (before_->stiffness - now_->stiffness) / std::abs(now_->t - before_->t);
  // also where a stiffness is not known
  if (!(fall > 0)) return step;
  const double to_zero = now_->stiffness / fall;
  return to_zero < 3 * step ? std::clamp(to_zero / 3, step / 8, step) : step;
}

// How a simulation follows its path: in load steps, over branches that end, to the rods' length;
// and what is read off the path afterwards.

namespace {

constexpr double push_step = 0.02;       // of the length scale: the largest load step
constexpr double actuation_step = 0.05;  // in the path parameter
constexpr double locate_mm = 5e-3;       // of prescribed move: to which a limit is located
constexpr int most_halvings = 5;         // of a load step that a finer mesh does not follow
constexpr double loads_ways = 4;         // of the loads, what counts as the length scale of a move
// branches left on one way; where rods press on one another they slip past each other again and
// again
constexpr std::size_t most_events = 8, most_events_in_contact = 64;

/// The same in the path parameter; where loads alone change, nothing is moved.
double located_to(double reach_mm) {
  constexpr double of_loads = 1e-3;
  return std::min(locate_mm / std::max(reach_mm, 1e-9), of_loads);
}

Event::Kind kind_of(Outcome limit) {
  if (limit == Outcome::contact) return Event::Kind::contact;
  return limit == Outcome::overbent ? Event::Kind::overbent : Event::Kind::locked;
}

}  // namespace

double Simulation::load_step() const {
  if (actuating_) return scene_->load_step * actuation_step;
  const double reach = shell_->reach_mm();
  return scene_->load_step * (reach > 0 ? push_step * scene_->length_scale_mm / reach : 0.1);
}

Report Simulation::go(double t, const Watch& watch, const BifurcationPolicy& leaving,
                      PathRecord* record) {
  const CallBegin begin = call_begin();
  std::vector<Event> events;
  const auto end = [&](Outcome outcome) {
    shell_->allow_unstable(false);
    // the leader may stand ahead of what is certified
    if (outcome != Outcome::reached && !at_limit(outcome)) shell_->back_to(shell_->state());
    Report done = report(outcome, shell_->state().t, begin);
    done.events = std::move(events);
    if (actuating_) set_progress(progress_at(done.t));
    return done;
  };
  const auto note_load_step = [&] {
    if (record) record->load_steps.push_back({shell_->point(), certificate(), contacts()});
  };
  // how far the rods were bent before a step, and what would then end the path
  const auto bent_now = [&] { return scene_->max_bending_strain > 0 ? bending_strain() : 0; };
  double bent = bent_now();
  Outcome limit = Outcome::reached;
  Event met;
  const auto beyond_limit = [&] {
    limit = limit_of_rods(bent);
    met = {};
    if (limit == Outcome::reached && scene_->stops_at_contact)
      if (const record::Contacts found = contacts(); !found.places.empty()) {
        limit = Outcome::contact;
        met.what = simulate::text_of(found.places.front(), scene_->footprint);
      }
    met.kind = kind_of(limit);
    return limit != Outcome::reached;
  };
  const auto end_at_limit = [&](Outcome outcome, Event at) {
    at.t = shell_->state().t;
    events.push_back(std::move(at));
    return end(outcome);
  };
  if (beyond_limit() && limit == Outcome::contact) {
    note_load_step();
    return end_at_limit(limit, met);
  }
  bool unstable_too = leaving.through_unstable;
  shell_->allow_unstable(unstable_too);
  // of a path that is followed for what happens on it
  StabilityStepControl softening;
  const auto take_softness = [&] {
    if (record && actuating_ && leaving.wanted && scene_->imperfection.chooses())
      softening.take(*shell_, watch);
  };
  note_load_step();
  take_softness();
  const bool contact = shell_->model(0).contact.any();
  const std::size_t most = contact ? most_events_in_contact : most_events;
  int halvings = 0;
  while (shell_->state().t != t) {
    if (watch.cancelled()) return end(Outcome::cancelled);
    const double now = shell_->state().t, left = t - now;
    const double step = softening.shortened(load_step()) / (1 << halvings);
    const int steps = std::max(1, int(std::ceil(std::abs(left) / step - 1e-9)));
    const double next = steps == 1 ? t : now + left / steps;
    const NestedState good = shell_->state();
    bent = bent_now();
    const NestedReport nested = shell_->advance(next, watch);
    if (nested.end == Outcome::cancelled) return end(Outcome::cancelled);
    if (nested.end == Outcome::reached) {
      if (beyond_limit()) {
        Outcome last = limit;
        Event at = met;
        bisect_to_last_accepted(
            next, good, [&] { return beyond_limit() ? (last = limit, at = met, false) : true; },
            watch);
        if (last == Outcome::contact) {
          at.error = located_to(shell_->reach_mm());
          if (shell_->state().t != good.t) note_load_step();
        }
        return end_at_limit(last, std::move(at));
      }
      halvings = std::max(halvings - 1, 0);
      note_load_step();
      take_softness();
      continue;
    }
    // a finer mesh that did not follow is asked again nearer by
    if (nested.end == Outcome::meshes_disagree && ++halvings <= most_halvings) {
      shell_->back_to(good);
      continue;
    }
    // what it finds beside a leader that it followed with trouble alone is another state
    const bool led = shell_->followed().t == next;
    if (nested.end == Outcome::unstable && led && halvings >= most_halvings)
      return end(Outcome::meshes_disagree);
    const bool branch_ended = nested.end == Outcome::unstable || nested.end == Outcome::lost;
    if (!leaving.wanted || !branch_ended || events.size() >= most) return end(nested.end);
    const auto kind =
        nested.end == Outcome::unstable ? Event::Kind::stability_lost : Event::Kind::turned_back;
    // what the finer meshes lost and the leader did not is not located yet
    if (shell_->followed().t == next && kind == Event::Kind::stability_lost) {
      bisect_to_last_accepted(
          next, good, [] { return true; }, watch);
      if (shell_->state().t != good.t) note_load_step();
    }
    events.push_back({kind, shell_->followed().t, {}, {}});
    if (kind == Event::Kind::stability_lost && !scene_->imperfection.chooses()) {
      shell_->back_to(shell_->state());
      shell_->allow_unstable(unstable_too = true);
      continue;
    }
    if (!leave(t, events.back(), record, watch))
      return end(watch.cancelled() ? Outcome::cancelled : nested.end);
    if (beyond_limit()) {
      // the rest beyond would need longer or thinner rods, or room where others are
      shell_->back_to(good);
      events.pop_back();
      return end_at_limit(limit, met);
    }
    note_load_step();
    softening.forget();
    take_softness();
  }
  return end(Outcome::reached);
}

/// Stands in the last certified state, between `good` and `beyond`, that is accepted.
void Simulation::bisect_to_last_accepted(double beyond, const NestedState& good,
                                         const std::function<bool()>& accepted,
                                         const Watch& watch) {
  const double enough = located_to(shell_->reach_mm());
  NestedState last = good;
  double bad = beyond;
  while (std::abs(bad - last.t) > enough && !watch.cancelled()) {
    shell_->back_to(last);
    const double middle = 0.5 * (last.t + bad);
    if (shell_->advance(middle, watch).end == Outcome::reached && accepted())
      last = shell_->state();
    else
      bad = middle;
  }
  shell_->back_to(last);
}

/// By how much the path parameter changes while the boundary moves by the length scale, or, where
/// that is sooner, the loads by what they are.
double Simulation::parameter_scale(double t) const {
  const PinnedMotion& motion = shell_->motion(0);
  const double speed = motion.speed(t);
  const double boundary = scene_->length_scale_mm / std::max(shell_->reach_mm() * speed, 0.1);
  const double rate = std::abs(speed * motion.load.change);
  if (rate == 0 || shell_->model(0).loads.empty()) return boundary;
  return std::min(boundary, loads_ways * std::abs(motion.factor_at(motion.load, t)) / rate);
}

/// The branch ended: comes to rest again a little further on. The meshes lose it at slightly
/// different places; beyond the last of them all find the new state.
bool Simulation::leave(double t, Event& event, PathRecord* record, const Watch& watch) {
  const PathPoint last = shell_->followed();
  const double way = t > last.t ? 1 : -1;
  for (double beyond = 1e-3; beyond < 0.1; beyond *= 2) {
    double there = last.t + way * beyond * parameter_scale(last.t);
    if (way * (there - t) > 0) there = t;
    std::vector<TimedState> moments;
    const auto rest =
        rest_after_bifurcation(*shell_, *scene_, last, event.kind, there, moments, watch);
    if (watch.cancelled()) return false;
    if (rest && shell_->start(there, *rest, watch).end == Outcome::reached) {
      event.to = there;
      event.leap = event.kind != Event::Kind::stability_lost ||
                   !on_branch_from(*shell_, *scene_, last, there, *rest, watch);
      shell_->apply_loads();
      if (record && !moments.empty())
        record->snaps.push_back({record->load_steps.size() - 1, std::move(moments)});
      return true;
    }
    if (there == t) break;
    // the path stands where it was lost
    shell_->back_to(shell_->state());
    shell_->place(last.t, last.state);
  }
  return false;
}

Report Simulation::sample(double t, const LoadStep& beside, bool unstable, const Watch& watch) {
  const CallBegin begin = call_begin();
  shell_->allow_unstable(unstable || !beside.certificate.stable());
  const NestedReport nested = shell_->sample(t, beside.point, watch);
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
