#include "engine/simulate/path_walk.h"

#include <algorithm>
#include <cmath>

#include "engine/core/file_io.h"
#include "engine/elastic/model.h"

namespace gridshell {
namespace {

constexpr double push_step = 0.02;       // largest load step of a push, over the length scale
constexpr double actuation_step = 0.05;  // largest load step of an actuation, in t
// branches left on one path; rods in contact slip past each other repeatedly
constexpr std::size_t most_events = 8, most_events_in_contact = 64;

}  // namespace

bool near_zero(const std::vector<simulate::LowestStiffness>& branch) {
  constexpr double low = 0.25;  // over the largest stiffness of the branch
  double largest = 0;
  for (const simulate::LowestStiffness& one : branch) largest = std::fmax(largest, one.stiffness);
  return !branch.empty() && branch.back().stiffness < low * largest;
}

double shortened_step(const std::vector<simulate::LowestStiffness>& branch, double step) {
  if (branch.size() < 2) return step;
  const auto &before = branch.end()[-2], &now = branch.back();
  const double fall = (before.stiffness - now.stiffness) / std::abs(now.t - before.t);
  // also where a stiffness is not known
  if (!(fall > 0)) return step;
  const double to_zero = now.stiffness / fall;
  return to_zero < 3 * step ? std::clamp(to_zero / 3, step / 8, step) : step;
}

double Simulation::load_step() const {
  if (actuating_) return scene_->load_step * actuation_step;
  const double reach = shell_->reach_mm();
  return scene_->load_step * (reach > 0 ? push_step * scene_->length_scale_mm / reach : 0.1);
}

Report Simulation::go(double t, const Watch& watch, const BifurcationPolicy& leaving,
                      PathRecord* record) {
  return Walk(*this, t, leaving, record, watch).all();
}

Report Simulation::Walk::all() {
  const CallBegin begin = of_.call_begin();
  shell_.allow_unstable(leaving_.through_unstable);
  shell_.watch_stability(watches_stability(), watch_);
  Outcome end = Outcome::reached;
  if (resume()) {
    end = segment_.end.value_or(end);
  } else {
    accept();
    save_segment({});
    if (too_coarse()) end = Outcome::too_coarse;
  }
  while (end == Outcome::reached && now() != to_) {
    end = step();
    if (end == Outcome::reached) save_segment({});
  }
  if (end != Outcome::cancelled) save_segment(end);
  shell_.allow_unstable(false);
  shell_.watch_stability(false);
  // the path may be ahead of what is certified
  if (end != Outcome::reached && !at_limit(end)) shell_.back_to(shell_.state());
  Report done = of_.report(end, now(), begin);
  done.events = std::move(segment_.events);
  if (of_.actuating_) of_.set_progress(progress_at(done.t));
  return done;
}

void Simulation::Walk::record_step() {
  if (record_) record_->load_steps.push_back({shell_.point(), of_.certificate(), of_.contacts()});
}

/// Reports the path parameter to the observer.
void Simulation::Walk::report_position() const {
  if (&watch_ != &unwatched) watch_.set_position(now(), shell_.plan().edges_per_segment.back());
}

/// Records the current state as a load step from which the path continues.
void Simulation::Walk::accept() {
  record_step();
  report_position();
  store_companion();
  if (!watches_stability()) return;
  segment_.lowest_stiffness.push_back({now(), shell_.state().lowest_eigenvalue});
  if (near_zero(segment_.lowest_stiffness))
    record_->load_steps.back().stability_confirmed = shell_.stability_confirmed(watch_);
}

// ---- segments saved by an earlier run ----

/// Whether an earlier run saved this segment or its start; the shell then has the state saved
/// there.
bool Simulation::Walk::resume() {
  if (!saved_) return false;
  segment_.begin = {Checksum::of({reinterpret_cast<const char*>(shell_.state().x.data()),
                                  sizeof(double) * std::size_t(shell_.state().x.size())}),
                    now(), to_, shell_.plan().edges_per_segment};
  effort_before_ = of_.effort();
  auto before = saved_->next(segment_.begin);
  if (!before) return false;
  segment_ = std::move(*before);
  of_.charge(segment_.effort);
  static_cast<PathRecord&>(*record_) = std::move(segment_.record);
  const bool stays = std::ranges::any_of(segment_.events, [](const Event& event) {
    return event.kind == Event::Kind::stability_lost && !event.to;
  });
  shell_.allow_unstable(leaving_.through_unstable || stays);
  shell_.back_to(segment_.state);
  note_return();
  report_position();
  return true;
}

/// Saves the segment if enough time was spent since the last save; the result of a cancelled step
/// is not saved.
void Simulation::Walk::save_segment(std::optional<Outcome> end) {
  if (!saved_ || !saved_->should_save(end.has_value())) return;
  segment_.end = end;
  segment_.state = shell_.state();
  segment_.effort = of_.effort() - effort_before_;
  // moved there and back, not copied, as it may be large
  std::swap<PathRecord>(segment_.record, *record_);
  saved_->save(segment_);
  std::swap<PathRecord>(segment_.record, *record_);
}

// ---- load steps ----

Outcome Simulation::Walk::step() {
  if (watch_.cancelled()) return Outcome::cancelled;
  const double left = to_ - now(),
               longest = shortened_step(segment_.lowest_stiffness, of_.load_step());
  // where the path follower needs short steps, load steps are at most eight times shorter, too
  const double step = std::clamp(shell_.state().step, longest / 8, longest);
  const int steps = std::max(1, int(std::ceil(std::abs(left) / step - 1e-9)));
  const double next = steps == 1 ? to_ : now() + left / steps;
  const NestedState good = shell_.state();
  const Outcome end = shell_.advance(next, watch_).end;
  if (end == Outcome::reached) return accept_step(next, good);
  const bool ended = end == Outcome::unstable || end == Outcome::lost;
  const std::size_t most = shell_.model().contact.any() ? most_events_in_contact : most_events;
  if (!ended || !leaving_.requested || segment_.events.size() >= most) return end;
  return branch_ended(end, next, good);
}

Outcome Simulation::Walk::accept_step(double next, const NestedState& good) {
  if (auto limit = of_.exceeded(limits_)) return end_before(std::move(*limit), next, good);
  note_return();
  accept();
  return too_coarse() ? Outcome::too_coarse : Outcome::reached;
}

/// Whether a path that started past a limit has returned: the limit then applies as usual.
void Simulation::Walk::note_return() {
  if (!from_past_limit_ || of_.exceeded_limit()) return;
  limits_ = of_.limits();
  from_past_limit_ = false;
}

/// Whether the path need not be followed further on this mesh: its error estimate is above the
/// allowed one, or no coarser mesh has had a state for longer than two meshes' events may differ.
bool Simulation::Walk::too_coarse() {
  const LevelPlan& plan = shell_.plan();
  if (!std::isfinite(plan.allowed_mm) || !of_.certificate().stable()) return false;
  if (shell_.state().measured < shell_.last()) {
    segment_.unmeasured_since.reset();
    return of_.certificate().error_estimate_mm > plan.allowed_mm;
  }
  if (!segment_.unmeasured_since) segment_.unmeasured_since = now();
  return std::abs(now() - *segment_.unmeasured_since) > plan.events_apart;
}

Report Simulation::sample(double t, const LoadStep& nearest, bool unstable, const Watch& watch,
                          const LoadStep* across) {
  const CallBegin begin = call_begin();
  shell_->allow_unstable(unstable || !nearest.certificate.stable());
  const NestedReport nested =
      shell_->sample(t, nearest.point, watch, across ? &across->point : nullptr);
  shell_->allow_unstable(false);
  return report(nested.end, nested.t, begin);
}

}  // namespace gridshell
