#include "engine/experiment/course.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/experiment/budget.h"

namespace gridshell::experiment {
namespace {

/// The station that a sample of a leg lies behind: the last one that the leg came past before it.
const Station& station_before(const Leg& leg, double t) {
  const double way = leg.to > leg.from ? 1 : -1;
  const Station* before = &leg.trail.stations.front();
  for (const Station& station : leg.trail.stations)
    if (way * (t - station.point.t) >= 0) before = &station;
  return *before;
}

/// The station that it lies in front of.
const Station& station_after(const Leg& leg, double t) {
  const double way = leg.to > leg.from ? 1 : -1;
  for (const Station& station : leg.trail.stations)
    if (way * (station.point.t - t) >= 0) return station;
  return leg.trail.stations.back();
}

}  // namespace

double Course::last_estimate_mm() const {
  if (legs.empty()) return 0;
  return legs.back().trail.stations.back().certificate.error_estimate_mm;
}

Result<Course> course_of(const Scene& scene, const Follow& follow, const Watch& watch) {
  LevelPlan plan = scene.edges_per_segment > 0 ? plan_of_mesh(scene.edges_per_segment)
                                               : plan_levels(scene.tolerance);
  const double allowed = scene.tolerance * scene.length_scale_mm;
  Effort spent;
  double setup = 0;
  for (;;) {
    auto course = follow(plan, watch);
    if (!course || watch.cancelled()) return course;
    course->seconds_setup += setup;
    course->session.charge(spent);
    const double last = course->last_estimate_mm();
    const bool asked = scene.edges_per_segment > 0;
    if (asked || !(last > allowed)) return course;
    const auto next = finer(plan);
    const auto fits = next ? fits_memory(scene, *next) : Result<void>{};
    if (!next || !fits)
      return fail(
          Fault::no_equilibrium,
          fmt::format("the tolerance {:g} is not met: {} edges a segment leave an "
                      "estimated error of {:.2g} mm, {:.2g} of the length scale{}",
                      scene.tolerance, plan.edges_per_segment.back(), last,
                      last / scene.length_scale_mm, fits ? "" : "; " + fits.error().message));
    plan = *next;
    spent = course->session.effort();
    setup = course->seconds_setup;
  }
}

Report stand_at(Course& course, const Sample& sample, const Watch& watch) {
  const Leg& leg = course.legs[sample.leg];
  const Station &before = station_before(leg, sample.t), &after = station_after(leg, sample.t);
  Report report = course.session.sample(sample.t, before, false, watch);
  // where a branch was left the state belongs to the next one, where that does not come so far
  // back to the rest beside it, and else it is an equilibrium that says what it is
  if (report.end != Outcome::reached && !watch.cancelled())
    report = course.session.sample(sample.t, after, false, watch);
  if (report.end == Outcome::unstable || report.end == Outcome::lost)
    report = course.session.sample_rest(sample.t, before, watch);
  if (report.end != Outcome::reached && !watch.cancelled())
    report = course.session.sample(sample.t, before, true, watch);
  return report;
}

void tell_limit(Course& course, const Leg& leg, const std::function<std::string(double)>& at) {
  std::string ends;
  for (const Event& event : leg.report.events)
    if (event.kind != Event::Kind::locked) ends += (ends.empty() ? "" : " and ") + at(event.t);
  if (!ends.empty()) {
    course.limit = record::Limit::snap;
    course.limit_reason =
        "the path lost its stability " + ends + " and came to rest in another state";
  }
  switch (leg.report.end) {
    case Outcome::reached:
    case Outcome::cancelled:
      return;
    case Outcome::locked: {
      course.limit = record::Limit::locking;
      course.limit_reason =
          fmt::format("{} the rods are at their length: the largest strain is {:.3g}",
                      at(leg.report.t), leg.report.certificate.largest_strain);
      return;
    }
    case Outcome::not_finite:
      course.limit = record::Limit::no_equilibrium;
      break;
    case Outcome::unstable:
    case Outcome::lost:
    case Outcome::folded:
    case Outcome::not_converged:
    case Outcome::meshes_disagree:
      course.limit = record::Limit::branch_lost;
      break;
  }
  course.limit_reason = fmt::format("{} {}, and no rest was found beyond",
                                    words_of(leg.report.end).what, at(leg.report.t));
}

}  // namespace gridshell::experiment
