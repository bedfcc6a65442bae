#include "engine/simulate/equilibrium_path.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/try.h"

namespace gridshell::simulate {
namespace {

/// The first load step at or past t.
const LoadStep& load_step_after(const PathSegment& segment, double t) {
  for (const LoadStep& load_step : segment.load_steps)
    if (segment.sign() * (load_step.point.t - t) >= 0) return load_step;
  return segment.load_steps.back();
}

/// Whether no event is between consecutive load steps, stable or not.
bool on_one_branch(const PathSegment& segment, const LoadStep& a, const LoadStep& b) {
  const double sign = segment.sign(), from = sign * a.point.t, to = sign * b.point.t;
  return from < to && std::ranges::none_of(segment.report.events, [&](const Event& event) {
           const double lost = event.location.t;
           const auto [begin, end] = std::minmax({sign * lost, sign * event.to.value_or(lost)});
           return begin < to && end > from;
         });
}

}  // namespace

bool at_event(const PathSegment& segment, double t) {
  constexpr double times = 2;  // estimated errors
  return std::ranges::any_of(segment.report.events, [t](const Event& event) {
    return !event.is_limit() && std::abs(t - event.t) <= times * event.error.value_or(0);
  });
}

const LoadStep* worst_load_step(const EquilibriumPath& path) {
  const LoadStep* worst = nullptr;
  for (const PathSegment& segment : path.segments)
    for (const LoadStep& load_step : segment.load_steps)
      if (load_step.certificate.stable() && !at_event(segment, load_step.point.t) &&
          load_step.certificate.error_estimate_mm >
              (worst ? worst->certificate.error_estimate_mm : -1))
        worst = &load_step;
  return worst;
}

double worst_estimate_mm(const EquilibriumPath& path) {
  const LoadStep* worst = worst_load_step(path);
  return worst ? worst->certificate.error_estimate_mm : std::numeric_limits<double>::quiet_NaN();
}

double distance_of_joints(const Simulation& simulation, const Eigen::Matrix3Xd& nodes) {
  const Eigen::Index joints = simulation.shell().finest().joints;
  return max_column_norm(simulation.nodes().leftCols(joints) - nodes.leftCols(joints));
}

const LoadStep& load_step_before(const PathSegment& segment, double t) {
  const LoadStep* before = &segment.load_steps.front();
  for (const LoadStep& load_step : segment.load_steps)
    if (segment.sign() * (t - load_step.point.t) >= 0) before = &load_step;
  return *before;
}

void PathSegment::free_states() {
  for (LoadStep& step : load_steps) {
    const double t = step.point.t;
    step.point = {};
    step.point.t = t;
  }
  path_end.reset();
  after.reset();
}

bool EquilibriumPath::too_coarse() const {
  const auto ended_so = [](const PathSegment& segment) {
    return segment.report.end == Outcome::too_coarse;
  };
  return std::ranges::any_of(segments, ended_so) || std::ranges::any_of(earlier, ended_so);
}

bool goes_on_between(const PathSegment& segment, const LoadStep& a, const LoadStep& b) {
  return a.certificate.stable() && b.certificate.stable() && on_one_branch(segment, a, b);
}

bool all_stable(const PathSegment& segment) {
  return std::ranges::all_of(segment.load_steps,
                             [](const LoadStep& step) { return step.certificate.stable(); });
}

bool within_snap(const PathSegment& segment, double t) {
  const double after = load_step_after(segment, t).point.t;
  return segment.sign() * (after - t) > 0 &&
         std::any_of(segment.report.events.begin(), segment.report.events.end(),
                     [&](const Event& event) { return event.to && *event.to == after; });
}

PathSegment& follow_segment(EquilibriumPath& path, double to, const BifurcationPolicy& leaving,
                            const Watch& watch) {
  Simulation& simulation = path.simulation;
  PathSegment segment{{}, simulation.shell().state().t, to, {}};
  const bool drawn = simulation.actuating() && simulation.scene().from_drawing;
  const auto exceeded = to < segment.from ? std::nullopt : simulation.exceeded_limit();
  segment.report = simulation.go(exceeded && !drawn ? segment.from : to, watch, leaving, &segment);
  if (exceeded && segment.report.end == Outcome::reached)
    if (const auto still = simulation.exceeded_limit()) {
      segment.report.end = outcome_of(still->kind);
      segment.report.events.push_back(*still);
    }
  segment.path_end = simulation.save();
  return path.segments.emplace_back(std::move(segment));
}

CertifiedSample certify_sample(EquilibriumPath& path, const PathSample& sample,
                               const Watch& watch) {
  const PathSegment& segment = path.segments[sample.segment];
  const double t = sample.t;
  const auto from = [&](const LoadStep& nearest, bool unstable) {
    return path.simulation.sample(t, nearest, unstable, watch);
  };
  const auto done = [&](const Report& report) {
    return report.end == Outcome::reached || watch.cancelled();
  };
  const LoadStep &before = load_step_before(segment, t), &after = load_step_after(segment, t);
  const bool goes_on = on_one_branch(segment, before, after);
  // between two load steps of one branch the state on that branch is meant, stable or not
  const bool inside = goes_on && t != before.point.t;
  Report report = path.simulation.sample(t, before, inside, watch, inside ? &after : nullptr);
  if (done(report)) return {report, t};
  // a branch was left in between: it may be a state of the next one
  if (&after != &before) report = from(after, false);
  if (done(report)) return {report, after.point.t};
  // or, where the next state does not extend back so far, the equilibrium to which the shell
  // snapped; not on a branch that continues between the two
  if ((report.end == Outcome::unstable || report.end == Outcome::lost) && !goes_on)
    report = path.simulation.certify_rest_at(t, before, watch);
  if (done(report)) return {report, after.point.t};
  // or any equilibrium; its certificate shows whether it is stable
  report = from(before, true);
  return {report, t};
}

double progress_on(const EquilibriumPath& path, std::size_t segment, double t) {
  if (!path.push) return progress_at(t);
  if (!path.push->unload) return t;
  return segment == 0 ? t / 2 : 1 - t / 2;
}

At EquilibriumPath::at_on(const PathSegment& segment) const {
  const bool moves = segment.after && segment.after->actuating && segment.load_steps.size() > 1;
  return moves ? at_progress : at;
}

std::string at_progress(double t, std::optional<double> error) {
  auto text = fmt::format("at progress {:.4f}", progress_at(t));
  if (error) text += fmt::format(" ± {:.1g}", 2 * t * *error);
  return text;
}

}  // namespace gridshell::simulate
