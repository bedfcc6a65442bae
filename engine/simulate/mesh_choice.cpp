#include "engine/simulate/mesh_choice.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "engine/simulate/expected_cost.h"
#include "engine/simulate/guided_path.h"

namespace gridshell::simulate {
namespace {

constexpr int most_leaders = 3;
constexpr double near_t = 0.05;  // events that two leaders place so near are the same
// of turns: frames between the coarser leader's and the true one show the state beyond
constexpr double same_t = 0.005;

int leading_edges_of(const EquilibriumPath& path) { return path.asked.edges_per_segment.front(); }

/// Whether every segment came to its end, or to a limit of the rods.
bool whole(const EquilibriumPath& path) {
  return std::ranges::all_of(path.segments, [](const PathSegment& segment) {
    return segment.report.end == Outcome::reached || at_limit(segment.report.end);
  });
}

std::optional<std::string> leg_disagreement(const PathSegment& a, const PathSegment& b) {
  const auto &seen = a.report.events, &found = b.report.events;
  if (seen.size() != found.size())
    return fmt::format("{} and {} losses of the branch", seen.size(), found.size());
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const bool limit = seen[k].is_limit() || found[k].is_limit();
    if ((limit && seen[k].kind != found[k].kind) ||
        seen[k].to.has_value() != found[k].to.has_value())
      return "events of another kind";
    if (std::abs(seen[k].t - found[k].t) > near_t)
      return fmt::format("path parameters {:.3f} and {:.3f} of an event", seen[k].t, found[k].t);
    if (seen[k].to && std::abs(*seen[k].to - *found[k].to) > near_t)
      return fmt::format("rests found at path parameters {:.3f} and {:.3f}", *seen[k].to,
                         *found[k].to);
  }
  if (std::abs(a.end() - b.end()) > near_t)
    return fmt::format("ends at path parameters {:.3f} and {:.3f}", a.end(), b.end());
  return std::nullopt;
}

/// Whether two meshes tell the same events, wherever.
bool same_events(const std::vector<PathSegment>& coarse, const std::vector<PathSegment>& fine) {
  return std::ranges::equal(coarse, fine, [](const PathSegment& a, const PathSegment& b) {
    return std::ranges::equal(a.report.events, b.report.events, {}, &Event::kind, &Event::kind);
  });
}

/// The places of events in both, extrapolated from the two meshes that placed them, an error of
/// second order. What one and the same mesh placed in both (the finest of one path leads the other)
/// stays where it is, its error not known.
void extrapolate_events(std::vector<PathSegment>& coarse, std::vector<PathSegment>& fine) {
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    auto &seen = coarse[k].report.events, &found = fine[k].report.events;
    for (std::size_t e = 0; e < seen.size(); ++e) {
      Event &a = seen[e], &b = found[e];
      const double times = double(b.placed.edges) / a.placed.edges;
      if (times == 1) {
        a.error = b.error = std::nullopt;
        continue;
      }
      const double left = (b.t - a.t) / (times * times - 1);
      // of a limit the finest mesh decides, and the state that is kept is its own
      if (!a.is_limit()) a.t = b.t = b.t + left;
      a.error = b.error =
          std::abs(left) + a.placed.located + b.placed.located + b.error.value_or(0);
      a.placed = b.placed;
    }
  }
}

/// Whether a path turns back, or branches, clearly further on where a finer leader leads.
bool ends_later(const std::vector<PathSegment>& coarse, const std::vector<PathSegment>& fine) {
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    const auto &early = coarse[k].report.events, &late = fine[k].report.events;
    for (std::size_t e = 0; e < early.size(); ++e) {
      const bool turns = early[e].kind == Event::Kind::turned_back;
      const double clearly = turns ? same_t : early[e].leap ? near_t : 2 * same_t;
      if (coarse[k].sign() * (late[e].t - early[e].t) > clearly) return true;
    }
  }
  return false;
}

/// Whether the finest mesh, too, loses its stability where two leaders say that the shell does:
/// past the event, by more than they differ. Where the leader cannot be followed there, it does.
bool seen_on_finest(EquilibriumPath& fine, const PathSegment& segment, const Event& event,
                    double coarse_t, const Watch& watch) {
  constexpr double least = 2e-3;  // in the path parameter
  const double apart = std::abs(event.t - coarse_t);
  const double there = event.t + segment.sign() * (apart + least);
  Simulation& simulation = fine.simulation;
  const Checkpoint end = simulation.save();
  const Report beyond = simulation.sample(there, load_step_before(segment, event.t), true, watch);
  simulation.restore(end);
  return beyond.end != Outcome::reached || !beyond.certificate.stable();
}

/// Losses of stability that the leaders of both paths see and the finest mesh does not: a
/// sentence, or nothing. Motions that are over are not looked at: the actuation before a push, and
/// steps.
std::optional<std::string> only_on_leaders(const EquilibriumPath& coarse, EquilibriumPath& fine,
                                           const Watch& watch) {
  if (!fine.single_motion) return std::nullopt;
  for (std::size_t k = 0; k < fine.segments.size(); ++k) {
    const auto &seen = coarse.segments[k].report.events, &events = fine.segments[k].report.events;
    for (std::size_t e = 0; e < events.size(); ++e) {
      const bool left = events[e].kind == Event::Kind::stability_lost && events[e].to;
      if (left && !seen_on_finest(fine, fine.segments[k], events[e], seen[e].t, watch))
        return fmt::format(
            "{} edges a segment do not lose their stability at path parameter {:.3f}",
            fine.simulation.shell().plan().edges_per_segment.back(), events[e].t);
    }
  }
  return std::nullopt;
}

/// The confirmed path on the coarsest meshes tried before that have it; else itself.
SharedPath on_coarsest(const Scene& scene, std::span<const SharedPath> tried, SharedPath confirmed,
                       const Watch& watch) {
  const double allowed = scene.tolerance * scene.length_scale_mm;
  for (const SharedPath& path : tried) {
    confirmed->simulation.shell().free_memory();
    const Effort before = path->simulation.effort();
    const bool followed = follow_guide(*path, *confirmed, allowed, watch);
    const Effort spent = path->simulation.effort() - before;
    if (!followed) {
      confirmed->simulation.charge(spent);
      continue;
    }
    // what led here counted once
    path->simulation.charge(confirmed->simulation.effort() - before);
    path->seconds_setup = confirmed->seconds_setup;
    return path;
  }
  return confirmed;
}

/// Whether the meshes of a plan have the states of a path on which nothing happened.
bool has_states(const LevelPlan& plan, EquilibriumPath& path, const Scene& scene,
                const Watch& watch) {
  // the scene outlives it
  auto fine = Simulation::open(std::shared_ptr<const Scene>(std::shared_ptr<void>(), &scene), plan);
  if (!fine) return false;
  const bool there = has_states_of(*fine, path, watch);
  path.simulation.charge(fine->effort());
  return there;
}

constexpr double found_to = 5e-5;  // in the path parameter

/// Where a mesh of the path ends a branch that its leader leaves; empty: not within reach.
std::optional<Event::Place> place_on(int level, EquilibriumPath& path, const PathSegment& segment,
                                     const Event& event, const Watch& watch) {
  constexpr double reach = 0.25;  // in the path parameter
  Simulation& simulation = path.simulation;
  NestedShell& shell = simulation.shell();
  const int edges = shell.plan().edges_per_segment[std::size_t(level)];
  if (event.placed.edges == edges) return event.placed;
  PathOptions options;
  options.spacing_mm = simulation.scene().footprint.spacing;
  // the last step that was too long may be nearly twice the smallest
  options.smallest_step = found_to / 2;
  const auto& steps = segment.load_steps;
  // of the branch that ends there: where the next rest stands may lie before the place told
  const auto end = std::ranges::find_if(
      steps, [&](const LoadStep& step) { return event.to && step.point.t == *event.to; });
  for (auto step = std::make_reverse_iterator(end); step != steps.rend(); ++step) {
    const double begin = step->point.t;
    if (segment.sign() * (event.t - begin) < 0) continue;
    if (std::abs(event.t - begin) > reach || watch.cancelled()) break;
    if (simulation.sample(begin, *step, false, watch).end != Outcome::reached) continue;
    PathFollower path_there(shell.system(level), shell.motion(level), options);
    const State state = shell.state().levels[std::size_t(level)];
    if (path_there.start(begin, state, watch).end != Outcome::reached) continue;
    const PathReport there = path_there.advance(event.t + segment.sign() * reach, watch);
    if (there.end == Outcome::reached) break;
    return Event::Place{edges, path_there.point().t, found_to};
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> mesh_disagreement(const EquilibriumPath& coarse,
                                             const EquilibriumPath& fine) {
  for (const auto segments : {&EquilibriumPath::earlier, &EquilibriumPath::segments}) {
    const auto &a = coarse.*segments, &b = fine.*segments;
    if (a.size() != b.size()) return "another way from the flat";
    for (std::size_t k = 0; k < a.size(); ++k)
      if (auto found = leg_disagreement(a[k], b[k])) return found;
  }
  if (coarse.segments.empty() || coarse.segments.back().end() != fine.segments.back().end())
    return std::nullopt;  // both ended early, at states of their own
  const double apart = distance_of_joints(coarse.simulation, fine.simulation.nodes()),
               d = coarse.simulation.scene().footprint.spacing;
  if (apart > near_spacings * d) return fmt::format("ends {:.3g} mm apart", apart);
  return std::nullopt;
}

void take_over(EquilibriumPath& path, const EquilibriumPath& from) {
  path.simulation.charge(from.simulation.effort());
  path.seconds_setup += from.seconds_setup;
}

Result<SharedPath> led_by_twice_the_edges(const Scene& scene, EquilibriumPath& path,
                                          const Follow& follow, const Watch& watch) {
  const auto plan = with_finer_leader(path.asked);
  if (!plan || !fits_memory(scene, *plan)) return SharedPath();
  path.simulation.shell().free_memory();
  auto fine = follow(*plan, watch);
  if (watch.cancelled()) return stopped();
  if (!fine) return SharedPath();
  (*fine)->asked = *plan;
  return fine;
}

bool settles(const EquilibriumPath& fine, const EquilibriumPath& path) {
  const Scene& scene = fine.simulation.scene();
  return begin_alike(path, fine) && uneventful(fine) &&
         worst_estimate_mm(fine) <= scene.tolerance * scene.length_scale_mm;
}

Result<SharedPath> confirm_on_finer_meshes(const Scene& scene, SharedPath path,
                                           const Follow& follow, const Watch& watch,
                                           bool one_motion) {
  // the first buckling is a choice too, which the coarsest mesh made
  const auto chose = [&] { return path->has_events() || !scene.from_net; };
  auto plan = std::optional(path->asked);
  std::vector<SharedPath> before;
  for (int asked = 0; asked < most_leaders && chose(); ++asked) {
    plan = with_finer_leader(*plan);
    if (!plan || !fits_memory(scene, *plan)) {
      path->mesh_disagreement = fmt::format(
          "no mesh finer than {} edges a segment led to confirm it", leading_edges_of(*path));
      return path;
    }
    if (asked == 0 && one_motion && !scene.leader_asked && !path->has_events() &&
        has_states(*plan, *path, scene, watch))
      return path;
    path->simulation.shell().free_memory();
    auto fine = follow(*plan, watch);
    if (watch.cancelled()) return stopped();
    if (!fine) {
      path->mesh_disagreement = fmt::format("with {} edges a segment leading: {}",
                                            plan->edges_per_segment.front(), fine.error().message);
      return path;
    }
    (*fine)->asked = *plan;
    const auto keep_fine = [&] {
      take_over(**fine, *path);
      before.push_back(std::exchange(path, std::move(*fine)));
    };
    auto differs = mesh_disagreement(*path, **fine);
    if (!differs) differs = only_on_leaders(*path, **fine, watch);
    if (!differs) {
      const bool later = path->single_motion && !scene.leader_asked &&
                         ends_later(path->segments, (*fine)->segments);
      extrapolate_events(path->segments, (*fine)->segments);
      extrapolate_events(path->earlier, (*fine)->earlier);
      path->mesh_disagreement.clear();
      if (later) {
        keep_fine();
        return path;
      }
      path->simulation.charge((*fine)->simulation.effort());
      break;
    }
    // a finer leader that meets nothing, its own finer meshes beside it, says that nothing is there
    const bool nothing = path->has_events() && begin_alike(*path, **fine) && uneventful(**fine);
    if (nothing && !scene.leader_asked) {
      keep_fine();
      path->mesh_disagreement.clear();
      break;
    }
    const std::string disagreed =
        fmt::format("leading meshes of {} and {} edges a segment do not agree: {}",
                    leading_edges_of(*path), leading_edges_of(**fine), *differs);
    // whoever asks for a leader has its path
    if (scene.leader_asked) {
      path->mesh_disagreement = disagreed;
      path->simulation.charge((*fine)->simulation.effort());
      return path;
    }
    // a path that came through is not given up for one that did not: a still finer one is asked
    if (whole(*path) && !whole(**fine)) {
      path->mesh_disagreement =
          fmt::format("a leading mesh of {} edges a segment did not come so far: {}",
                      leading_edges_of(**fine), *differs);
      path->simulation.charge((*fine)->simulation.effort());
      continue;
    }
    keep_fine();
    path->mesh_disagreement = disagreed;
    if (!chose()) path->mesh_disagreement.clear();
  }
  // what stays in doubt stays where it was found
  return path->mesh_disagreement.empty() ? on_coarsest(scene, before, path, watch) : path;
}

SharedPath led_by_finer(SharedPath path, const Follow& follow, const Watch& watch) {
  LevelPlan plan = path->asked;
  while (!whole(*path) && plan.edges_per_segment.size() > 1 && !watch.cancelled()) {
    plan.edges_per_segment.erase(plan.edges_per_segment.begin());
    auto fine = follow(plan, watch);
    if (!fine || !whole(**fine)) continue;
    (*fine)->asked = plan;
    take_over(**fine, *path);
    (*fine)->mesh_disagreement = fmt::format(
        "meshes coarser than {} edges a segment did not come so far", leading_edges_of(**fine));
    return *fine;
  }
  return path;
}

std::string why_so_fine(const EquilibriumPath& path) {
  constexpr double clearly = 10;
  const Scene& scene = path.simulation.scene();
  const double allowed = scene.tolerance * scene.length_scale_mm, worst = worst_estimate_mm(path);
  if (scene.edges_per_segment > 0 || !(worst > 0 && clearly * worst < allowed)) return "";
  const std::string over =
      fmt::format("the error estimate is {:.1g} of the tolerance, as ", worst / allowed);
  if (path.asked.edges_per_segment.front() > initial_levels(scene).edges_per_segment.front())
    return over + "coarser meshes do not follow the branch that finer ones confirm";
  return over + (path.asked.extrapolate ? "coarser meshes leave more than it, as a rule"
                                        : "on fewer meshes the error would not be known");
}

void locate_on_meshes(EquilibriumPath& path, const Follow& follow, const Watch& watch) {
  const int last = path.simulation.shell().levels() - 1;
  if (last == 0 && path.has_events()) {
    const LevelPlan plan{{2 * leading_edges_of(path)}, false};
    if (!fits_memory(path.simulation.scene(), plan)) return;
    path.simulation.shell().free_memory();
    const auto fine = follow(plan, watch);
    if (!fine) return;
    (*fine)->asked = plan;
    path.simulation.charge((*fine)->simulation.effort());
    if (same_events(path.segments, (*fine)->segments))
      extrapolate_events(path.segments, (*fine)->segments);
    else if (path.mesh_disagreement.empty())
      path.mesh_disagreement = fmt::format(
          "a mesh of {} edges a segment does not tell the same: {}", leading_edges_of(**fine),
          mesh_disagreement(path, **fine).value_or("events of another kind"));
  }
  if (last == 0 || !path.single_motion) return;
  const Checkpoint end = path.simulation.save();
  const int finest = path.simulation.shell().plan().edges_per_segment.back();
  for (PathSegment& segment : path.segments)
    for (Event& event : segment.report.events) {
      if (event.is_limit() || (event.error && event.placed.edges >= finest)) continue;
      const auto fine = place_on(last, path, segment, event, watch);
      const auto coarse = fine ? place_on(last - 1, path, segment, event, watch) : fine;
      if (!coarse) continue;
      // what coarser leaders said tells whether the order is seen yet
      const double left = (fine->t - coarse->t) / 3, before = event.t;
      event.t = fine->t + left;
      event.error = std::abs(left) + fine->located + coarse->located +
                    (event.error ? std::abs(event.t - before) : 0);
    }
  path.simulation.restore(end);
}

}  // namespace gridshell::simulate
