#include "engine/experiment/actuation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/clock.h"
#include "engine/experiment/frames.h"
#include "engine/solve/buckle.h"

namespace gridshell::experiment {
namespace {

// of the rods, where the first buckled state is looked for: the first that is connected to the flat
constexpr double first_shortening[] = {0.02, 0.01, 0.005, 0.0025};
constexpr double flat_shortening = 1e-3;  // how near to the flat the path is followed

std::string at_progress(double t) { return fmt::format("at progress {:.4f}", t * t); }

/// Goes on from where the session stands, and keeps the way as a leg.
Leg& follow_leg(Course& course, double to, const Leaving& leaving, const Watch& watch) {
  Leg leg{course.session.shell().state().t, to, {}, {}};
  leg.report = course.session.go(to, watch, leaving, &leg.trail);
  return course.legs.emplace_back(std::move(leg));
}

Error stopped() { return {Fault::cancelled, "stopped"}; }

/// Back from the first state towards the flat. The symmetric state that the path comes from need
/// not be stable all the way: its frames say so.
bool follow_back(Course& course, const Watch& watch) {
  const NestedShell& shell = course.session.shell();
  const auto nearly_flat = parameter_of_shortening(shell.mesh(0), shell.motion(0), flat_shortening);
  const double t = shell.state().t;
  const Leg& back = follow_leg(course, nearly_flat ? std::min(*nearly_flat, t) : 0,
                               {.wanted = false, .through_unstable = true}, watch);
  if (back.report.end == Outcome::reached || watch.cancelled()) return true;
  course.limit = record::Limit::no_equilibrium;
  course.limit_reason = fmt::format("{} on the way back to the flat {}",
                                    words_of(back.report.end).what, at_progress(back.report.t));
  return false;
}

/// The first buckled state, and the way back from it to the flat.
Result<Checkpoint> begin_from_flat(Course& course, const Watch& watch) {
  Result<Checkpoint> found = fail(Fault::no_equilibrium, "no buckled state was certified");
  for (double shortening : first_shortening) {
    const auto first = course.session.begin_buckled(shortening, watch);
    if (watch.cancelled()) return tl::unexpected<Error>(stopped());
    if (!first && found) break;
    if (!first) return tl::unexpected<Error>(first.error());
    if (first->end != Outcome::reached) continue;
    Course tried{std::move(course.session), {}, record::Limit::none, {}, course.seconds_setup};
    Checkpoint start = tried.session.save();
    const bool connected = follow_back(tried, watch);
    if (connected || !found) {
      course.legs = std::move(tried.legs);
      course.limit = tried.limit;
      course.limit_reason = tried.limit_reason;
      found = std::move(start);
    }
    course.session = std::move(tried.session);
    if (connected) break;
  }
  return found;
}

}  // namespace

Result<Course> follow_actuation(std::shared_ptr<const Scene> scene, const LevelPlan& plan,
                                bool inner, double to, const Watch& watch) {
  const double started = seconds_now();
  auto session = Session::open(scene, plan);
  if (!session) return tl::unexpected<Error>(session.error());
  Course course{std::move(*session), {}, record::Limit::none, {}, seconds_now() - started};
  if (to == 0) return course;
  const double end_t = std::sqrt(to);
  if (scene->from_net) {
    const auto first = course.session.begin_on_net(watch);
    if (!first) return tl::unexpected<Error>(first.error());
    if (first->end != Outcome::reached)
      return fail(
          Fault::no_equilibrium,
          fmt::format("the state beside the net is not certified: {}", words_of(first->end).what));
    const Checkpoint start = course.session.save();
    if (inner) {
      follow_back(course, watch);
      course.session.restore(start);
    }
    follow_leg(course, 1, {}, watch);
    return course;
  }
  const auto start = begin_from_flat(course, watch);
  if (!start) return tl::unexpected<Error>(start.error());
  course.session.restore(*start);
  const double t = start->state.t;
  if (end_t >= t) tell_limit(course, follow_leg(course, end_t, {}, watch), at_progress);
  if (watch.cancelled()) return tl::unexpected<Error>(stopped());
  return course;
}

namespace {

/// Where the frames of a leg's samples go, in order.
class Frames {
 public:
  Frames(const Scene& scene, Course& course, record::Sink& sink, Watch& watch, std::size_t count)
      : scene_(scene), course_(course), sink_(sink), watch_(watch), count_(count) {}

  Result<void> flat(int index) {
    record::Frame frame = flat_frame(course_.session);
    return take(std::move(frame), index, 0);
  }

  /// One sample; false where the leg ended before it.
  Result<bool> at(const Sample& sample, double progress) {
    const int before = course_.session.effort().newton_iterations;
    const Report report = stand_at(course_, sample, watch_);
    if (watch_.cancelled()) return tl::unexpected<Error>(stopped());
    if (report.end != Outcome::reached) {
      if (course_.limit == record::Limit::none || course_.limit == record::Limit::snap) {
        course_.limit = record::Limit::branch_lost;
        course_.limit_reason =
            fmt::format("{} {}", words_of(report.end).what, at_progress(sample.t));
      }
      return false;
    }
    if (auto moved = motion(sample, progress); !moved) return tl::unexpected<Error>(moved.error());
    record::Frame frame = frame_of(course_.session);
    frame.event = event(sample);
    if (frame.event.empty() && frame.negative_pivots > 0)
      frame.event = fmt::format("unstable: {} negative pivots", frame.negative_pivots);
    frame.newton_iterations = course_.session.effort().newton_iterations - before;
    if (auto taken = take(std::move(frame), sample.index, progress); !taken)
      return tl::unexpected<Error>(taken.error());
    return true;
  }

 private:
  /// Frames of snaps that lie before a sample and were not shown yet.
  Result<void> motion(const Sample& sample, double progress) {
    const Trail& trail = course_.legs[sample.leg].trail;
    for (; next_snap_ < trail.snaps.size(); ++next_snap_) {
      const Trail::Snap& snap = trail.snaps[next_snap_];
      if (trail.stations[snap.before + 1].point.t > sample.t) break;
      for (record::Frame& frame : frames_in_motion(course_.session, snap.moments))
        if (auto taken = take(std::move(frame), 0, progress); !taken) return taken;
    }
    // the session stood somewhere else for them
    if (next_snap_ > 0) stand_at(course_, sample, watch_);
    return {};
  }

  /// What happened to the leg since the sample before.
  std::string event(const Sample& sample) {
    const auto& events = course_.legs[sample.leg].report.events;
    std::string text;
    if (course_.legs[sample.leg].to < course_.legs[sample.leg].from) return text;
    for (; next_event_ < events.size(); ++next_event_) {
      const Event& one = events[next_event_];
      if (!one.to || *one.to > sample.t) break;
      text += fmt::format("{}{:.4f}", text.empty() ? "snap at progress " : " and ", one.t * one.t);
    }
    return text;
  }

  Result<void> take(record::Frame frame, int index, double progress) {
    // with frames of a snap in between, all are counted
    frame.index = scene_.snap.wanted ? taken_ : index;
    frame.progress = frame.actuation = progress;
    frame.boundary_radius_mm = scene_.radius_at(progress);
    ++taken_;
    watch_.report(0.5 + 0.5 * double(taken_) / double(count_));
    return sink_.take(std::move(frame));
  }

  const Scene& scene_;
  Course& course_;
  record::Sink& sink_;
  Watch& watch_;
  std::size_t count_, next_event_ = 0, next_snap_ = 0;
  int taken_ = 0;
};

/// Whether straight rods lie in the flat without a force; its frame is then exact.
bool rests_flat(const Scene& scene) {
  return std::all_of(scene.rods.materials.begin(), scene.rods.materials.end(),
                     [](const RodMaterial& material) { return material.curvature.isZero(0); });
}

/// The leg on which a path parameter lies, if there is one.
std::optional<std::size_t> leg_at(const Course& course, double t) {
  for (std::size_t k = course.legs.size(); k-- > 0;) {
    const Leg& leg = course.legs[k];
    double end = leg.trail.stations.back().point.t;
    // nearer to the flat than it was followed nothing happens any more
    if (leg.to < leg.from && leg.report.end == Outcome::reached) end = 0;
    if (std::min(leg.from, end) <= t && t <= std::max(leg.from, end)) return k;
  }
  return std::nullopt;
}

}  // namespace

Result<Course> run_actuation(std::shared_ptr<const Scene> scene,
                             const std::vector<double>& progress, record::Sink& sink,
                             Watch& watch) {
  const bool inner =
      std::any_of(progress.begin(), progress.end(), [](double p) { return p > 0 && p < 1; });
  auto course = course_of(
      *scene,
      [&](const LevelPlan& plan, const Watch& w) {
        return follow_actuation(scene, plan, inner, progress.back(), w);
      },
      watch);
  if (!course) return course;
  auto layout = layout_of(*scene, course->session.shell().finest());
  if (!layout) return tl::unexpected<Error>(layout.error());
  if (auto begun = sink.begin(std::move(*layout)); !begun)
    return tl::unexpected<Error>(begun.error());
  Frames frames(*scene, *course, sink, watch, progress.size());
  const Checkpoint end = course->session.save();
  for (std::size_t k = 0; k < progress.size(); ++k) {
    if (progress[k] == 0 && rests_flat(*scene)) {
      if (auto flat = frames.flat(int(k)); !flat) return tl::unexpected<Error>(flat.error());
      continue;
    }
    const double t = std::sqrt(progress[k]);
    const auto leg = leg_at(*course, t);
    if (!leg) continue;  // the course's limit says why
    const auto taken = frames.at({int(k), *leg, t}, progress[k]);
    if (!taken) return tl::unexpected<Error>(taken.error());
  }
  course->session.restore(end);
  return course;
}

}  // namespace gridshell::experiment
