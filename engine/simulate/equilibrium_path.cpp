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
  const auto begun = to < segment.from ? std::nullopt : simulation.exceeded_limit();
  segment.report = simulation.go(begun ? segment.from : to, watch, leaving, &segment);
  if (begun) {
    segment.report.end = outcome_of(begun->kind);
    segment.report.events.push_back(*begun);
  }
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

namespace {

record::Limit limit_of(Outcome end) {
  switch (end) {
    case Outcome::reached:
    case Outcome::cancelled:
      return record::Limit::none;
    case Outcome::locked:
      return record::Limit::locking;
    case Outcome::overbent:
      return record::Limit::strength;
    case Outcome::contact:
      return record::Limit::contact;
    case Outcome::not_finite:
      return record::Limit::no_equilibrium;
    case Outcome::unstable:
    case Outcome::lost:
    case Outcome::folded:
    case Outcome::not_converged:
    case Outcome::too_coarse:
      break;
  }
  return record::Limit::branch_lost;
}

/// A sentence on why a segment ended before its requested end.
std::string how_it_ended(const PathSegment& segment, double max_strain, const At& at) {
  const Report& report = segment.report;
  const auto where = [&] {
    return at(report.t, report.events.empty() ? std::nullopt : report.events.back().error);
  };
  const bool begun = report.t == segment.from;
  if (report.end == Outcome::overbent)
    return fmt::format("{} a rod is strained {} [limits] {} allows",
                       begun ? "where the path begins, " + at(report.t, {}) + "," : where(),
                       begun ? "further than" : "as far as", report.events.back().what);
  if (report.end == Outcome::locked && !report.events.back().what.empty())
    return fmt::format(
        "{} the shell snaps, to an equilibrium in which the rods are longer or shorter than "
        "[limits] "
        "max_strain allows",
        where());
  const double strain = report.certificate.largest_strain;
  const bool strained = locked_by_strain(strain, max_strain);
  if (report.end == Outcome::locked && strained && strain < 0)
    return fmt::format(
        "{} a rod too short to buckle is compressed as far as [limits] max_strain allows: its "
        "strain is {:.3g}",
        at(report.t, {}), strain);
  if (report.end == Outcome::locked)
    return at(report.t, {}) + " " + text_of_locking(strain, max_strain);
  if (report.end == Outcome::contact) {
    const std::string& what = report.events.back().what;
    const bool touched = !segment.load_steps.back().contacts.interpenetrations.empty();
    if (touched && begun) return what + " touch in the first state already, " + at(report.t, {});
    if (touched) return where() + " what touched in the first state would overlap more: " + what;
    return fmt::format("{} is the last state without contact: past it {} touch", where(), what);
  }
  if (segment.back)
    return fmt::format(
        "{} on the path back to the flat {}, and no equilibrium was found past it: the states from "
        "there on "
        "are certified; how the flat state leads to them is not known",
        words_of(report.end).what, at(report.t, {}));
  return fmt::format("{} {}, and no equilibrium was found past it", words_of(report.end).what,
                     at(report.t, {}));
}

}  // namespace

std::string text_of_locking(double largest_strain, double max_strain) {
  return locked_by_strain(largest_strain, max_strain)
             ? fmt::format("the rods reached the strain limit: the largest strain is {:.3g}",
                           largest_strain)
             : "the push met 100 times its first stiffness";
}

std::string limit_event(const Simulation& simulation, Outcome end) {
  if (end == Outcome::locked) return "locking";
  if (end == Outcome::overbent) return "strength";
  if (end != Outcome::contact) return "";
  return simulation.contacts().interpenetrations.empty() ? "last state without contact"
                                                         : "in contact from the start";
}

std::string branch_losses(std::span<const PathSegment> segments, const At& at, bool jump) {
  std::string losses;
  for (const PathSegment& segment : segments)
    for (const Event& event : segment.report.events)
      if (event.to && event.jump == jump)
        losses += (losses.empty() ? "" : " and ") + at(event.t, event.error);
  return losses;
}

std::string at_parameter(double t, std::optional<double> error) {
  auto text = fmt::format("at path parameter {:.3f}", t);
  if (error) text += fmt::format(" ± {:.1g}", *error);
  return text;
}

void set_limit(EquilibriumPath& path) {
  const At& at = path.at;
  path.limit = record::Limit::none;
  path.limit_reason.clear();
  std::string reported;
  for (const PathSegment& segment : path.segments) {
    const auto ended = limit_of(segment.report.end);
    if (ended != record::Limit::none) {
      const bool going_back = segment.back && !at_limit(segment.report.end);
      path.limit = going_back ? record::Limit::no_equilibrium : ended;
      path.limit_reason = how_it_ended(segment, path.simulation.scene().max_strain, at);
      break;
    }
    const char* on_path = segment.back ? "on the path back to the flat " : "";
    const auto branches = branch_losses({&segment, 1}, at, false);
    if (!branches.empty())
      reported += fmt::format(
          "{}{}the path branches {} and continues without a snap to the side that the imperfection "
          "chose",
          reported.empty() ? "" : "; ", on_path, branches);
    const auto losses = branch_losses({&segment, 1}, at);
    if (losses.empty() || path.limit != record::Limit::none) continue;
    path.limit = record::Limit::snap;
    reported += fmt::format("{}{}the path lost its stability {} and reached another equilibrium",
                            reported.empty() ? "" : "; ", on_path, losses);
  }
  if (path.limit_reason.empty()) path.limit_reason = reported;
  if (path.mesh_disagreement.empty()) return;
  path.limit_reason += (path.limit_reason.empty() ? "" : "; ") + path.mesh_disagreement;
}

}  // namespace gridshell::simulate
