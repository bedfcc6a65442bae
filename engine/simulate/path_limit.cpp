// Why a path ended, and what happened on it, as text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/simulate/actuation.h"
#include "engine/simulate/equilibrium_path.h"
#include "engine/solve/arc_follower.h"

namespace gridshell::simulate {
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

/// Text on the limit that a path met which ended as `locked`: that of the strain, or that of the
/// stiffness of a push.
std::string text_of_locking(double largest_strain, double max_strain) {
  return locked_by_strain(largest_strain, max_strain)
             ? fmt::format("the rods reached the strain limit: the largest strain is {:.3g}",
                           largest_strain)
             : "the push met 100 times its first stiffness";
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

/// Parameters at which the segments lost a branch and continued in another equilibrium, by a snap
/// (`jump`) or along a branch that bifurcates there: "at progress 0.0183 and at ..."; empty if none
/// did.
std::string branch_losses(std::span<const PathSegment> segments, const At& at, bool jump = true) {
  std::string losses;
  for (const PathSegment& segment : segments)
    for (const Event& event : segment.report.events)
      if (event.to && event.jump == jump)
        losses += (losses.empty() ? "" : " and ") + at(event.t, event.error);
  return losses;
}

/// Text on the limit point of the path that was lost, found by arc length; empty: none was found.
std::string turning_back(Simulation& simulation, const PathSegment& segment, const Event& event,
                         double depth_mm, const Watch& watch) {
  // the last load step before the snap: the event's parameter may be extrapolated past later steps
  const LoadStep* last = nullptr;
  for (const LoadStep& load_step : segment.load_steps) {
    if (event.to && load_step.point.t == *event.to) break;
    last = &load_step;
  }
  if (!last) return {};
  const ArcOptions fine{.step_mm = 0.05, .largest_mm = 0.2, .parameter_mm = depth_mm};
  const auto turn = turning_point(simulation.shell().system(), simulation.shell().motion(),
                                  last->point, segment.sign(), fine, watch);
  return turn ? fmt::format(" (on its mesh the path has a limit point at {:.3f} mm)",
                            *turn * depth_mm)
              : std::string();
}

/// Why the push of [indentation] stopped or which events it passed, in the terms of a push: the
/// first snap, or the segment that ended; empty if the common text applies.
std::string reason_of_push(EquilibriumPath& pushed, const Watch& watch) {
  const At& at = pushed.at;
  const Scene& scene = pushed.simulation.scene();
  if (pushed.limit == record::Limit::snap)
    for (const PathSegment& segment : pushed.segments)
      for (const Event& event : segment.report.events)
        if (event.to && event.jump)
          return fmt::format(
              "with the joint prescribed, the shell lost its {} {}{} and reached another "
              "equilibrium",
              event.kind == Event::Kind::stability_lost ? "stability" : "equilibrium",
              at(event.t, event.error),
              turning_back(pushed.simulation, segment, event, pushed.push->depth_mm(), watch));
  const PathSegment& segment = pushed.segments.back();
  const double strain = segment.report.certificate.largest_strain;
  if (pushed.limit == record::Limit::locking && strain != 0)
    return fmt::format("{} ({:.4f} of the length scale) and {:.4g} N {}", at(segment.report.t, {}),
                       segment.report.t * pushed.push->depth_mm() / scene.length_scale_mm,
                       pushed.push->displacement.normalized().dot(pushed.simulation.force(0)),
                       text_of_locking(strain, scene.max_strain));
  return {};
}

/// Sets the limit and its reason from how the segments ended. Of steps each sentence names its own.
void set_end(EquilibriumPath& path) {
  path.limit = record::Limit::none;
  path.limit_reason.clear();
  std::string reported;
  for (const PathSegment& segment : path.segments) {
    const At at = path.at_on(segment);
    const std::string step =
        segment.step.empty()
            ? ""
            : fmt::format("step {} ({}): ", &segment - path.segments.data() + 1, segment.step);
    const auto ended = limit_of(segment.report.end);
    if (ended != record::Limit::none) {
      const bool going_back = segment.back && !at_limit(segment.report.end);
      path.limit = going_back ? record::Limit::no_equilibrium : ended;
      path.limit_reason = step + how_it_ended(segment, path.simulation.scene().max_strain, at);
      break;
    }
    const char* on_path = segment.back ? "on the path back to the flat " : "";
    const auto branches = branch_losses({&segment, 1}, at, false);
    if (!branches.empty())
      reported += fmt::format(
          "{}{}{}the path branches {} and continues without a snap to the side that the "
          "imperfection "
          "chose",
          reported.empty() ? "" : "; ", step, on_path, branches);
    const auto losses = branch_losses({&segment, 1}, at);
    if (losses.empty() || (path.limit != record::Limit::none && step.empty())) continue;
    path.limit = record::Limit::snap;
    reported += fmt::format("{}{}{}the path lost its stability {} and reached another equilibrium",
                            reported.empty() ? "" : "; ", step, on_path, losses);
  }
  if (path.limit_reason.empty()) path.limit_reason = reported;
}

}  // namespace

bool snapped(const PathSegment& segment) {
  return std::ranges::any_of(segment.report.events,
                             [](const Event& one) { return one.to && one.jump; });
}

std::string limit_event(const Simulation& simulation, Outcome end) {
  if (end == Outcome::locked) return "locking";
  if (end == Outcome::overbent) return "strength";
  if (end != Outcome::contact) return "";
  return simulation.contacts().interpenetrations.empty() ? "last state without contact"
                                                         : "in contact from the start";
}

void set_limit(EquilibriumPath& path, const Watch& watch) {
  set_end(path);
  if (!path.refused.empty()) {
    path.limit = record::Limit::no_equilibrium;
    path.limit_reason = path.refused;
    return;
  }
  const auto add = [&](const std::string& more) {
    path.limit_reason += (path.limit_reason.empty() ? "" : "; ") + more;
  };
  if (path.push)
    if (auto reason = reason_of_push(path, watch); !reason.empty())
      path.limit_reason = std::move(reason);
  // which shell was pushed, or took the steps, depends on earlier events
  const char* later = path.push ? "before the push " : "before its steps ";
  if (const auto losses = branch_losses(path.earlier, at_progress); !losses.empty()) {
    if (path.limit == record::Limit::none) path.limit = record::Limit::snap;
    add(later + ("the path lost its stability " + losses) + " and reached another equilibrium");
  }
  for (const PathSegment& segment : path.earlier)
    if (segment.report.end != Outcome::reached) {
      if (path.limit == record::Limit::none || path.limit == record::Limit::snap)
        path.limit = at_limit(segment.report.end) ? limit_of(segment.report.end)
                                                  : record::Limit::no_equilibrium;
      add(later + how_it_ended(segment, path.simulation.scene().max_strain, at_progress));
    }
  if (!path.mesh_disagreement.empty()) add(path.mesh_disagreement);
}

std::vector<std::string> messages_of_steps(const EquilibriumPath& path) {
  std::vector<std::string> messages;
  for (const PathSegment& segment : path.segments) {
    if (segment.step.empty()) continue;
    const Report& report = segment.report;
    std::string text =
        fmt::format("{} {}: {}", messages.size() + 1, segment.step, words_of(report.end).name);
    for (const Event& event : report.events)
      if (event.to)
        text += fmt::format(", {} {}", event.jump ? "snap to another state" : "branches",
                            path.at_on(segment)(event.t, event.error));
    const Certificate& certificate = report.certificate;
    text += fmt::format(", residual {:.2g} N, ", certificate.residual_N);
    text += certificate.stable()
                ? "stable"
                : fmt::format("unstable: {} negative pivots", certificate.negative_pivots);
    if (std::isfinite(certificate.error_estimate_mm))
      text += fmt::format(", error {:.2g} mm", certificate.error_estimate_mm);
    messages.push_back(text + segment.reported);
  }
  return messages;
}

}  // namespace gridshell::simulate
