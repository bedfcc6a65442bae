#include "engine/simulate/mesh_policy.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/core/try.h"
#include "engine/simulate/actuation.h"
#include "engine/simulate/expected_cost.h"

namespace gridshell::simulate {
namespace {

int edges_of(const EquilibriumPath& path) { return path.meshes.edges_per_segment.back(); }

/// Whether an event of a segment is near a path parameter: meshes may differ there.
bool near_event(const PathSegment& segment, double t) {
  return std::ranges::any_of(segment.report.events, [&](const Event& event) {
    const auto [from, to] = std::minmax({event.location.t, event.t, event.to.value_or(event.t)});
    return t > from - mesh_tolerances.same_event && t < to + mesh_tolerances.same_event;
  });
}

std::optional<std::string> not_confirmed(const PathSegment& segment, int companion, const At& at) {
  for (const Event& event : segment.report.events)
    if (!event.confirmed)
      return fmt::format("{} edges per segment do not have the event {}", companion,
                         at(event.t, {}));
  for (const LoadStep& step : segment.load_steps) {
    if (!step.stability_confirmed && !near_event(segment, step.point.t))
      return fmt::format(
          "stability {}: the lowest stiffness there is smaller than its "
          "difference from that of {} edges per segment",
          at(step.point.t, {}), companion);
    const bool last = &step == &segment.load_steps.back();
    if (std::isnan(step.certificate.error_estimate_mm) && step.certificate.stable() &&
        (last || !near_event(segment, step.point.t)))
      return fmt::format("{} edges per segment have no such state {}", companion,
                         at(step.point.t, {}));
  }
  return std::nullopt;
}

/// Whether two segments have the same events, near each other, to the same end.
bool agree(const PathSegment& a, const PathSegment& b) {
  const auto near = [](double s, double t) {
    return std::abs(s - t) <= mesh_tolerances.same_event;
  };
  const auto same = [&](const Event& seen, const Event& found) {
    const bool limit = seen.is_limit() || found.is_limit();
    return (!limit || seen.kind == found.kind) && seen.to.has_value() == found.to.has_value() &&
           near(seen.t, found.t);
  };
  return std::ranges::equal(a.report.events, b.report.events, same) && near(a.end(), b.end());
}

/// Where the largest error is; next to a loss of stability a state moves most with the parameter.
std::string where_worst(const EquilibriumPath& path) {
  const LoadStep* worst = worst_load_step(path);
  if (!worst) return "";
  const double t = worst->point.t;
  const auto on = std::ranges::find_if(path.segments, [worst](const PathSegment& segment) {
    return worst >= segment.load_steps.data() &&
           worst < segment.load_steps.data() + segment.load_steps.size();
  });
  const bool near = near_event(*on, t);
  return fmt::format(", {}{}", path.at_on(*on)(t, {}),
                     near ? ", next to an event, where a state moves most" : "");
}

/// The positions of events that a mesh's own companion does not have, extrapolated from those on
/// two meshes.
void extrapolate_events(const std::vector<PathSegment>& coarse, std::vector<PathSegment>& fine) {
  for (std::size_t k = 0; k < fine.size(); ++k)
    for (std::size_t e = 0; e < fine[k].report.events.size(); ++e) {
      Event& event = fine[k].report.events[e];
      if (!event.confirmed) event.extrapolate(coarse[k].report.events[e].location);
    }
}

}  // namespace

LevelPlan initial_levels(const Scene& scene) {
  // the error over the length scale grows with the number of segments of a rod; measured on circles
  // of 12 to 96 rods per direction
  std::size_t segments = mesh_tolerances.segments;
  for (const FootprintRod& rod : scene.footprint.rods)
    if (!scene.from_net) segments = std::max(segments, rod.joints.size() + 1);
  const double growth = double(segments) / mesh_tolerances.segments;
  LevelPlan plan = scene.edges_per_segment > 0
                       ? plan_of_mesh(scene.edges_per_segment)
                       : plan_levels(scene.tolerance, scene.base_edges, growth);
  if (scene.rods.contact.barrier.acts()) plan.extrapolate = false;  // as NestedShell::make()
  return plan;
}

std::optional<std::string> not_confirmed(const EquilibriumPath& path) {
  const auto& edges = path.meshes.edges_per_segment;
  if (edges.size() < 2) return std::nullopt;
  const int companion = edges[edges.size() - 2];
  for (const PathSegment& segment : path.earlier)
    if (auto found = not_confirmed(segment, companion, at_progress)) return found;
  for (const PathSegment& segment : path.segments)
    if (auto found = not_confirmed(segment, companion, path.at_on(segment))) return found;
  return std::nullopt;
}

bool meshes_agree(const EquilibriumPath& coarse, const EquilibriumPath& fine) {
  if (!std::ranges::equal(coarse.earlier, fine.earlier, agree) ||
      !std::ranges::equal(coarse.segments, fine.segments, agree))
    return false;
  if (coarse.segments.empty() || coarse.segments.back().end() != fine.segments.back().end())
    return true;  // both ended early, at states of their own
  return distance_of_joints(coarse.simulation, fine.simulation.nodes()) <=
         mesh_tolerances.same_state * coarse.simulation.scene().footprint.spacing;
}

Result<EquilibriumPath> converged_path(const Scene& scene, const Follow& follow,
                                       const Watch& watch) {
  LevelPlan plan = initial_levels(scene);
  const bool requested = scene.edges_per_segment > 0;
  const double allowed =
      requested ? std::numeric_limits<double>::infinity() : scene.tolerance * scene.length_scale_mm;
  plan.allowed_mm = allowed;
  plan.events_apart = mesh_tolerances.same_event;
  TRY_DO(fits_memory(scene, plan));
  std::optional<EquilibriumPath> coarse;
  Result<void> fits;
  bool finest = false;  // whether no finer mesh is possible
  for (int doublings = 0;;) {
    auto path = follow(plan, watch);
    if (!path || watch.cancelled()) return path;
    EquilibriumPath& found = *path;
    found.meshes = plan;
    if (coarse) {
      found.simulation.charge(coarse->simulation.effort());
      found.seconds_setup += coarse->seconds_setup;
    }
    const bool too_coarse = found.too_coarse();
    auto missing = too_coarse ? std::nullopt : not_confirmed(found);
    if (std::isinf(plan.allowed_mm) || (!too_coarse && !missing)) {
      const double worst = worst_estimate_mm(found);
      found.tolerance_missed = finest && !(worst <= allowed);
      if (found.tolerance_missed)
        missing = fmt::format(
            "the tolerance {:g} is not met: {} edges per segment leave an estimated error of "
            "{:.2g} mm, {:.2g} of the length scale{}{}",
            scene.tolerance, plan.edges_per_segment.back(), worst, worst / scene.length_scale_mm,
            where_worst(found), fits ? "" : "; " + fits.error().message);
      found.mesh_disagreement = missing.value_or("");
      return path;
    }
    // two consecutive meshes agree
    if (missing && coarse && !coarse->too_coarse() && meshes_agree(*coarse, found)) {
      extrapolate_events(coarse->segments, found.segments);
      extrapolate_events(coarse->earlier, found.earlier);
      return path;
    }
    const auto next = finer(plan);
    fits = next ? fits_memory(scene, *next) : Result<void>{};
    finest = !next || !fits;
    if (missing && (finest || doublings >= mesh_tolerances.doublings)) {
      found.mesh_disagreement = *missing;
      return path;
    }
    if (!too_coarse) ++doublings;
    // only the events and the end of a coarser path are compared
    found.simulation.shell().free_memory();
    for (auto* segments : {&found.earlier, &found.segments})
      for (PathSegment& segment : *segments) segment.free_states();
    coarse = std::move(found);
    if (!finest) plan = *next;
    // on the finest possible mesh the path is followed to its end, with a report of what it misses
    plan.allowed_mm = finest ? std::numeric_limits<double>::infinity() : allowed;
  }
}

std::string why_so_fine(const EquilibriumPath& path) {
  const Scene& scene = path.simulation.scene();
  const double allowed = scene.tolerance * scene.length_scale_mm, worst = worst_estimate_mm(path);
  if (scene.edges_per_segment > 0 ||
      !(worst > 0 && mesh_tolerances.clearly_finer * worst < allowed))
    return "";
  const std::string over =
      fmt::format("the error estimate is {:.1g} of the tolerance, as ", worst / allowed);
  if (edges_of(path) > initial_levels(scene).edges_per_segment.back())
    return over + "coarser meshes do not have the events or states that finer ones have";
  return over + (path.meshes.edges_per_segment.size() > 2
                     ? "the error of coarser meshes is usually above the tolerance"
                     : "on fewer meshes the error would not be known");
}

}  // namespace gridshell::simulate
