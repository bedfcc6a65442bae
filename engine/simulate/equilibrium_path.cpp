#include "engine/simulate/equilibrium_path.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/core/try.h"
#include "engine/simulate/frames.h"
#include "engine/simulate/mesh_choice.h"

namespace gridshell::experiment {
namespace {

/// The station that it lies in front of.
const LoadStep& load_step_after(const PathSegment& leg, double t) {
  for (const LoadStep& station : leg.trail.stations)
    if (leg.way() * (station.point.t - t) >= 0) return station;
  return leg.trail.stations.back();
}

/// Largest error estimate where stable states were certified on a way that was followed forwards,
/// mm; NaN where one is not known.
double worst_estimate_mm(const EquilibriumPath& course) {
  double worst = 0;
  for (const PathSegment& leg : course.legs)
    for (const LoadStep& station : leg.trail.stations) {
      const double estimate = station.certificate.error_estimate_mm;
      if (station.certificate.stable() && !(estimate <= worst)) worst = estimate;
    }
  return worst;
}

}  // namespace

double distance_of_joints(const Session& session, const Eigen::Matrix3Xd& nodes) {
  const Eigen::Index joints = session.shell().finest().joints;
  return max_column_norm(session.nodes().leftCols(joints) - nodes.leftCols(joints));
}

const LoadStep& load_step_before(const PathSegment& leg, double t) {
  const LoadStep* before = &leg.trail.stations.front();
  for (const LoadStep& station : leg.trail.stations)
    if (leg.way() * (t - station.point.t) >= 0) before = &station;
  return *before;
}

bool EquilibriumPath::has_events() const {
  const auto any = [](const PathSegment& leg) {
    return !leg.report.events.empty() || leg.report.end != Outcome::reached;
  };
  return std::any_of(legs.begin(), legs.end(), any) ||
         std::any_of(earlier.begin(), earlier.end(), any);
}

bool within_snap(const PathSegment& leg, double t) {
  const double after = load_step_after(leg, t).point.t;
  return leg.way() * (after - t) > 0 &&
         std::any_of(leg.report.events.begin(), leg.report.events.end(),
                     [&](const Event& event) { return event.to && *event.to == after; });
}

PathSegment& follow_segment(EquilibriumPath& course, double to, const BifurcationPolicy& leaving,
                            const Watch& watch) {
  PathSegment leg{course.session.shell().state().t, to, {}, {}};
  leg.report = course.session.go(to, watch, leaving, &leg.trail);
  return course.legs.emplace_back(std::move(leg));
}

LevelPlan initial_levels(const Scene& scene) {
  return scene.edges_per_segment > 0 ? plan_of_mesh(scene.edges_per_segment)
                                     : plan_levels(scene.tolerance, scene.leading_edges);
}

Result<EquilibriumPath> converged_path(const Scene& scene, const Follow& follow,
                                       const Watch& watch) {
  LevelPlan plan = initial_levels(scene);
  const double allowed = scene.tolerance * scene.length_scale_mm;
  const bool asked = scene.edges_per_segment > 0;
  Effort spent;
  double setup = 0;
  for (;;) {
    TRY_DO(fits_memory(scene, plan));
    auto course = follow(plan, watch);
    if (!course || watch.cancelled()) return course;
    course->asked = plan;
    course->seconds_setup += setup;
    course->session.charge(spent);
    const double worst = worst_estimate_mm(*course);
    if (asked) return course;
    if (!(worst > allowed))
      return confirm_on_finer_meshes(scene, std::move(*course), follow, watch);
    const auto next = finer(plan);
    const auto fits = next ? fits_memory(scene, *next) : Result<void>{};
    if (!next || !fits)
      return fail(
          Fault::no_equilibrium,
          fmt::format("the tolerance {:g} is not met: {} edges a segment leave an "
                      "estimated error of {:.2g} mm, {:.2g} of the length scale{}",
                      scene.tolerance, plan.edges_per_segment.back(), worst,
                      worst / scene.length_scale_mm, fits ? "" : "; " + fits.error().message));
    plan = *next;
    spent = course->session.effort();
    setup = course->seconds_setup;
  }
}

namespace {

/// The last station of a branch that the leading mesh left before t, where finer ones, as is told,
/// leave it after t.
const LoadStep* last_of_a_branch_left_early(const PathSegment& leg, double t) {
  const auto& stations = leg.trail.stations;
  for (const Event& event : leg.report.events) {
    if (!event.to || leg.way() * (event.t - t) <= 0) continue;
    for (std::size_t k = 1; k < stations.size(); ++k)
      if (stations[k].point.t == *event.to && leg.way() * (t - stations[k - 1].point.t) > 0)
        return &stations[k - 1];
  }
  return nullptr;
}

}  // namespace

CertifiedSample certify_sample(EquilibriumPath& course, const PathSample& sample,
                               const Watch& watch) {
  const PathSegment& leg = course.legs[sample.leg];
  const double t = sample.t;
  const auto from = [&](const LoadStep& beside, bool unstable) {
    return course.session.sample(t, beside, unstable, watch);
  };
  const auto done = [&](const Report& report) {
    return report.end == Outcome::reached || watch.cancelled();
  };
  if (const LoadStep* still = last_of_a_branch_left_early(leg, t))
    for (const bool leader_unstable : {false, true}) {
      const Report held = from(*still, leader_unstable);
      if (done(held) && held.certificate.stable()) return {held, still->point.t};
    }
  const LoadStep &before = load_step_before(leg, t), &after = load_step_after(leg, t);
  Report report = from(before, false);
  if (done(report)) return {report, t};
  // a branch was left in between: it may be a state of the next one
  report = from(after, false);
  if (done(report)) return {report, after.point.t};
  // or, where the next one does not come back so far, the rest to which the shell went
  if (report.end == Outcome::unstable || report.end == Outcome::lost)
    report = course.session.certify_rest_at(t, before, watch);
  if (done(report)) return {report, after.point.t};
  // or any equilibrium, which says what it is
  return {from(before, true), t};
}

namespace {

record::Limit limit_of(Outcome end) {
  switch (end) {
    case Outcome::reached:
    case Outcome::cancelled:
      return record::Limit::none;
    case Outcome::locked:
      return record::Limit::locking;
    case Outcome::not_finite:
      return record::Limit::no_equilibrium;
    case Outcome::unstable:
    case Outcome::lost:
    case Outcome::folded:
    case Outcome::not_converged:
    case Outcome::meshes_disagree:
      break;
  }
  return record::Limit::branch_lost;
}

/// How a leg ended before its end.
std::string how_it_ended(const PathSegment& leg, const At& at) {
  const Report& report = leg.report;
  const double strain = report.certificate.largest_strain;
  if (report.end == Outcome::locked && strain < 0)
    return fmt::format(
        "{} a rod too short to buckle is compressed as far as [limits] max_strain allows: its "
        "strain is {:.3g}",
        at(report.t, {}), strain);
  if (report.end == Outcome::locked)
    return fmt::format("{} the rods are at their length: the largest strain is {:.3g}",
                       at(report.t, {}), strain);
  const char* where = leg.back ? " on the way back to the flat" : "";
  return fmt::format("{}{} {}, and no rest was found beyond", words_of(report.end).what, where,
                     at(report.t, {}));
}

}  // namespace

std::string branch_loss_places(std::span<const PathSegment> legs, const At& at) {
  std::string places;
  for (const PathSegment& leg : legs)
    for (const Event& event : leg.report.events)
      if (event.to) places += (places.empty() ? "" : " and ") + at(event.t, event.error);
  return places;
}

void set_limit(EquilibriumPath& course, const At& at) {
  course.limit = record::Limit::none;
  course.limit_reason.clear();
  for (const PathSegment& leg : course.legs) {
    const auto ended = limit_of(leg.report.end);
    if (ended != record::Limit::none) {
      const bool on_its_way = leg.back && ended != record::Limit::locking;
      course.limit = on_its_way ? record::Limit::no_equilibrium : ended;
      course.limit_reason = how_it_ended(leg, at);
      break;
    }
    const auto places = branch_loss_places({&leg, 1}, at);
    if (places.empty() || course.limit != record::Limit::none) continue;
    course.limit = record::Limit::snap;
    course.limit_reason =
        fmt::format("{}the path lost its stability {} and came to rest in another state",
                    leg.back ? "on the way back to the flat " : "", places);
  }
  if (course.mesh_disagreement.empty()) return;
  course.limit_reason += (course.limit_reason.empty() ? "" : "; ") + course.mesh_disagreement;
}

Result<bool> PathSampler::at(const PathSample& sample) {
  const int before = course_.session.effort().newton_iterations;
  const auto [report, past] = certify_sample(course_, sample, watch_);
  if (watch_.cancelled()) return stopped();
  if (report.end != Outcome::reached) {
    if (within_snap(course_.legs[sample.leg], sample.t)) {
      course_.limit_reason += "; there is no state to show " + caption_.at(sample.t, {});
    } else if (course_.limit == record::Limit::none || course_.limit == record::Limit::snap) {
      course_.limit = record::Limit::branch_lost;
      course_.limit_reason =
          fmt::format("{} {}", words_of(report.end).what, caption_.at(sample.t, {}));
    }
    return false;
  }
  TRY_DO(motions(sample, past));
  record::Frame frame = frame_of(course_.session);
  caption_.measure(frame);
  frame.event = events(sample, past);
  if (frame.event.empty() && frame.negative_pivots > 0)
    frame.event = fmt::format("unstable: {} negative pivots", frame.negative_pivots);
  frame.newton_iterations = course_.session.effort().newton_iterations - before;
  TRY_DO(take(std::move(frame), sample));
  last_ = sample;
  last_past_ = past;
  return true;
}

Result<void> PathSampler::stand(const PathSample& sample, const std::string& event, double past) {
  record::Frame frame = frame_of(course_.session);
  caption_.measure(frame);
  frame.event = event;
  last_ = sample;
  last_past_ = past;
  return take(std::move(frame), sample);
}

Result<void> PathSampler::take(record::Frame frame, const PathSample& sample) {
  // with frames of a snap in between, all are counted
  frame.index = course_.session.scene().snap.wanted ? taken_ : sample.index;
  frame.progress = sample.progress;
  caption_.stand(frame, sample.t, sample.progress);
  ++taken_;
  watch_.report(0.5 + 0.5 * double(taken_) / double(count_));
  return sink_.take(std::move(frame));
}

/// Frames of snaps that the leg came past since the sample before.
Result<void> PathSampler::motions(const PathSample& sample, double past) {
  const PathSegment& leg = course_.legs[sample.leg];
  if (!last_ || last_->leg != sample.leg) next_snap_ = 0;
  bool any = false;
  for (; next_snap_ < leg.trail.snaps.size(); ++next_snap_) {
    const PathRecord::Snap& snap = leg.trail.snaps[next_snap_];
    const double landed = leg.trail.stations[snap.before + 1].point.t;
    if (leg.way() * (past - landed) < 0) break;
    any = true;
    PathSample there = sample;
    there.t = landed;
    for (record::Frame& frame : frames_in_motion(course_.session, snap.moments))
      if (auto taken = take(std::move(frame), there); !taken) return taken;
  }
  // the session stood somewhere else for them
  if (any) certify_sample(course_, sample, watch_);
  return {};
}

/// A leg back is shown against its way: from its end to where it began.
std::string PathSampler::events(const PathSample& sample, double past) const {
  const PathSegment& leg = course_.legs[sample.leg];
  const double way = leg.back ? -leg.way() : leg.way();
  double before = leg.back ? leg.end() : leg.from;
  if (last_ && last_->leg == sample.leg) before = last_past_;
  std::string text;
  for (const Event& event : leg.report.events) {
    if (!event.to) continue;
    const double seen = leg.back ? event.t : *event.to;
    if (way * (seen - before) <= 0 || way * (past - seen) < 0) continue;
    text += (text.empty() ? "snap " : " and ") + caption_.at(event.t, {});
  }
  return text;
}

}  // namespace gridshell::experiment
