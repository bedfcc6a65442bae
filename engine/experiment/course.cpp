#include "engine/experiment/course.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/experiment/confirm.h"
#include "engine/session/budget.h"

namespace gridshell::experiment {
namespace {

/// The station that it lies in front of.
const Station& station_after(const Leg& leg, double t) {
  for (const Station& station : leg.trail.stations)
    if (leg.way() * (station.point.t - t) >= 0) return station;
  return leg.trail.stations.back();
}

/// Largest error estimate where stable states were certified on a way that was followed forwards,
/// mm; NaN where one is not known.
double worst_estimate_mm(const Course& course) {
  double worst = 0;
  for (const Leg& leg : course.legs)
    for (const Station& station : leg.trail.stations) {
      const double estimate = station.certificate.error_estimate_mm;
      if (station.certificate.stable() && !(estimate <= worst)) worst = estimate;
    }
  return worst;
}

}  // namespace

double distance_of_joints(const Session& session, const Eigen::Matrix3Xd& nodes) {
  const Eigen::Index joints = session.shell().finest().joints;
  return largest_column(session.nodes().leftCols(joints) - nodes.leftCols(joints));
}

const Station& station_before(const Leg& leg, double t) {
  const Station* before = &leg.trail.stations.front();
  for (const Station& station : leg.trail.stations)
    if (leg.way() * (t - station.point.t) >= 0) before = &station;
  return *before;
}

bool Course::eventful() const {
  const auto any = [](const Leg& leg) {
    return !leg.report.events.empty() || leg.report.end != Outcome::reached;
  };
  return std::any_of(legs.begin(), legs.end(), any) ||
         std::any_of(earlier.begin(), earlier.end(), any);
}

bool in_a_jump(const Leg& leg, double t) {
  const double after = station_after(leg, t).point.t;
  return leg.way() * (after - t) > 0 &&
         std::any_of(leg.report.events.begin(), leg.report.events.end(),
                     [&](const Event& event) { return event.to && *event.to == after; });
}

Leg& follow_leg(Course& course, double to, const Leaving& leaving, const Watch& watch) {
  Leg leg{course.session.shell().state().t, to, {}, {}};
  leg.report = course.session.go(to, watch, leaving, &leg.trail);
  return course.legs.emplace_back(std::move(leg));
}

LevelPlan first_plan(const Scene& scene) {
  return scene.edges_per_segment > 0 ? plan_of_mesh(scene.edges_per_segment)
                                     : plan_levels(scene.tolerance, scene.leading_edges);
}

Result<Course> course_of(const Scene& scene, const Follow& follow, const Watch& watch) {
  LevelPlan plan = first_plan(scene);
  const double allowed = scene.tolerance * scene.length_scale_mm;
  const bool asked = scene.edges_per_segment > 0;
  Effort spent;
  double setup = 0;
  for (;;) {
    if (auto fits = fits_memory(scene, plan); !fits) return tl::unexpected<Error>(fits.error());
    auto course = follow(plan, watch);
    if (!course || watch.cancelled()) return course;
    course->asked = plan;
    course->seconds_setup += setup;
    course->session.charge(spent);
    const double worst = worst_estimate_mm(*course);
    if (asked) return course;
    if (!(worst > allowed)) return confirmed(scene, std::move(*course), follow, watch);
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
const Station* last_of_a_branch_left_early(const Leg& leg, double t) {
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

Stood stand_at(Course& course, const Sample& sample, const Watch& watch) {
  const Leg& leg = course.legs[sample.leg];
  const double t = sample.t;
  const auto from = [&](const Station& beside, bool unstable) {
    return course.session.sample(t, beside, unstable, watch);
  };
  const auto done = [&](const Report& report) {
    return report.end == Outcome::reached || watch.cancelled();
  };
  if (const Station* still = last_of_a_branch_left_early(leg, t))
    for (const bool leader_unstable : {false, true}) {
      const Report held = from(*still, leader_unstable);
      if (done(held) && held.certificate.stable()) return {held, still->point.t};
    }
  const Station &before = station_before(leg, t), &after = station_after(leg, t);
  Report report = from(before, false);
  if (done(report)) return {report, t};
  // a branch was left in between: it may be a state of the next one
  report = from(after, false);
  if (done(report)) return {report, after.point.t};
  // or, where the next one does not come back so far, the rest to which the shell went
  if (report.end == Outcome::unstable || report.end == Outcome::lost)
    report = course.session.sample_rest(t, before, watch);
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
std::string how_it_ended(const Leg& leg, const At& at) {
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

std::string places_left(std::span<const Leg> legs, const At& at) {
  std::string places;
  for (const Leg& leg : legs)
    for (const Event& event : leg.report.events)
      if (event.to) places += (places.empty() ? "" : " and ") + at(event.t, event.error);
  return places;
}

void tell_limit(Course& course, const At& at) {
  course.limit = record::Limit::none;
  course.limit_reason.clear();
  for (const Leg& leg : course.legs) {
    const auto ended = limit_of(leg.report.end);
    if (ended != record::Limit::none) {
      const bool on_its_way = leg.back && ended != record::Limit::locking;
      course.limit = on_its_way ? record::Limit::no_equilibrium : ended;
      course.limit_reason = how_it_ended(leg, at);
      break;
    }
    const auto places = places_left({&leg, 1}, at);
    if (places.empty() || course.limit != record::Limit::none) continue;
    course.limit = record::Limit::snap;
    course.limit_reason =
        fmt::format("{}the path lost its stability {} and came to rest in another state",
                    leg.back ? "on the way back to the flat " : "", places);
  }
  if (course.doubt.empty()) return;
  course.limit_reason += (course.limit_reason.empty() ? "" : "; ") + course.doubt;
}

}  // namespace gridshell::experiment
