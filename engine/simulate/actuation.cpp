#include "engine/simulate/actuation.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/core/system_info.h"
#include "engine/core/try.h"
#include "engine/elastic/model.h"
#include "engine/simulate/branch_switch.h"
#include "engine/simulate/first_state.h"
#include "engine/simulate/frames.h"
#include "engine/simulate/mesh_policy.h"
#include "engine/simulate/path_doubt.h"
#include "engine/simulate/path_sampler.h"
#include "engine/simulate/shell_symmetry.h"
#include "engine/solve/buckling.h"

namespace gridshell::simulate {
namespace {

// mean shortenings at which the first buckled state is searched for, until it is connected to the
// flat state
constexpr double first_shortening[] = {0.02, 0.01, 0.005, 0.0025, flat_shortening};

/// Follows the path from the first state back towards the flat one. Returns whether it got there.
bool follow_back(EquilibriumPath& path, const BifurcationPolicy& leaving, const Watch& watch) {
  const NestedShell& shell = path.simulation.shell();
  const auto nearly_flat = parameter_of_shortening(shell.finest(), shell.motion(), flat_shortening);
  const double t = shell.state().t;
  PathSegment& back =
      follow_segment(path, nearly_flat ? std::min(*nearly_flat, t) : 0, leaving, watch);
  back.back = true;
  return back.report.end == Outcome::reached;
}

/// The first buckled state and the path from it back to the flat state, also through unstable
/// states, so that these are detected.
Result<Checkpoint> begin_from_flat(EquilibriumPath& path, const Watch& watch) {
  Result<Checkpoint> found = fail(Fault::no_equilibrium, "no buckled state was certified");
  for (double shortening : first_shortening) {
    const auto first = path.simulation.begin_buckled(shortening, watch);
    if (watch.cancelled()) return stopped();
    // a settlement across the rods may shorten them less
    if (!first && !found) found = tl::unexpected<Error>(first.error());
    if (!first || first->end != Outcome::reached) continue;
    std::vector<PathSegment> before = std::exchange(path.segments, {});
    Checkpoint start = path.simulation.save();
    const bool connected = follow_back(path, {.requested = false, .through_unstable = true}, watch);
    // a mesh too coarse to reach the flat says nothing about the branch: a finer one decides
    const bool decided = connected || path.too_coarse();
    if (decided || !found)
      found = std::move(start);
    else
      path.segments = std::move(before);
    if (decided || watch.cancelled()) break;
  }
  return found;
}

/// Whether the path from the current state next to the flat leads to the first state. It does not
/// if the first state is on a branch that bifurcates from it.
bool leads_to(EquilibriumPath& path, const Checkpoint& first, const Watch& watch) {
  Simulation& simulation = path.simulation;
  const Report there =
      simulation.sample(first.state.t, path.segments.front().load_steps.back(), false, watch);
  const bool same = there.end == Outcome::reached &&
                    distance_of_joints(simulation, first.state.x) <
                        mesh_tolerances.same_state * simulation.scene().footprint.spacing;
  simulation.restore(*path.segments.front().path_end);
  return same;
}

/// Selects, from the current state and its mirror images, which are equivalent, the one whose
/// diagonal is lower according to the seed; from several, the one on the imperfection's side.
void turn_to_seed(Simulation& simulation, const Watch& watch) {
  const NestedShell& shell = simulation.shell();
  const RodMesh& mesh = shell.finest();
  const Model& model = shell.model();
  if (model.has_spins()) return;
  const double d = simulation.scene().footprint.spacing, equal_mm = 5e-8 * d;
  const double t = shell.state().t, diagonal = simulation.scene().seed.diagonal;
  const Checkpoint here = simulation.save();
  const Eigen::Matrix3Xd nodes = shell.state().levels.back().x.leftCols(model.nodes);
  const Eigen::Matrix3Xd side = departure_of(simulation.scene(), mesh, model).start;
  const auto along_side = [&](const Eigen::Matrix3Xd& x) {
    return side.size() > 0 ? product(side.leftCols(mesh.joints), x.leftCols(mesh.joints)) : 0;
  };
  Eigen::Matrix3Xd best = nodes;
  for (const MeshSymmetry& symmetry :
       symmetries_of_shell(simulation.scene(), mesh, symmetries_of(mesh, shell.motion().at(t)))) {
    const Eigen::Matrix3Xd image = symmetry.of(nodes);
    const double lower =
        diagonal * (lower_on_diagonal(mesh, image) - lower_on_diagonal(mesh, best));
    const bool same = std::abs(lower) <= equal_mm;
    if (!symmetry.turns_over() &&
        (lower > equal_mm || (same && along_side(image) - along_side(best) > 5e-5 * d)))
      best = image;
  }
  if (best != nodes &&
      simulation.begin_at(t, start_state(model, best), watch).end != Outcome::reached)
    simulation.restore(here);
}

/// Continues from the first state, or from the current state next to the flat if the path from the
/// flat does not lead to the first state through stable states or branches.
void follow_from_flat(EquilibriumPath& path, const Checkpoint& first, double to,
                      const Watch& watch) {
  Simulation& simulation = path.simulation;
  const PathSegment& back = path.segments.front();
  const bool connected = back.report.end == Outcome::reached;
  // a contact on the segment back would have stopped the path in the other direction
  const bool stopped = simulation.scene().stops_at_contact &&
                       std::ranges::any_of(back.load_steps, [](const LoadStep& load_step) {
                         return !load_step.contacts.interpenetrations.empty();
                       });
  if (connected && (stopped || simulation.scene().imperfection.chooses())) {
    const bool straight =
        all_stable(back) && !breaks_more(simulation, first.state.x) && leads_to(path, first, watch);
    const bool rests =
        !straight && (all_stable(back) || simulation.rest(watch).end == Outcome::reached);
    if (rests || watch.cancelled()) {
      path.segments.clear();
      turn_to_seed(simulation, watch);
      // nearer to the flat state there are no events
      follow_segment(path, to, {}, watch).from = 0;
      return;
    }
  }
  simulation.restore(first);
  if (!connected) turn_to_seed(simulation, watch);
  if (to >= first.state.t) follow_segment(path, to, {}, watch);
}

/// The segment that contains a path parameter, if there is one.
std::optional<std::size_t> segment_at(const EquilibriumPath& path, double t) {
  for (std::size_t k = path.segments.size(); k-- > 0;) {
    const PathSegment& segment = path.segments[k];
    double end = segment.end();
    // nearer to the flat state than the segment was followed there are no events
    if (segment.back && segment.report.end == Outcome::reached) end = 0;
    if (std::min(segment.from, end) <= t && t <= std::max(segment.from, end)) return k;
  }
  return std::nullopt;
}

/// Whether the rods have no natural curvature: the flat state then has no forces, and its frame is
/// exact.
bool rests_flat(const Scene& scene) {
  return !scene.from_drawing &&
         std::ranges::all_of(scene.rods.materials, [](const RodMaterial& material) {
           return material.curvature.isZero(0);
         });
}

/// The samples at `progress`; states that the path does not have are left out.
std::vector<PathSample> samples_at(const EquilibriumPath& path,
                                   const std::vector<double>& progress) {
  std::vector<PathSample> samples;
  for (std::size_t k = 0; k < progress.size(); ++k) {
    PathSample sample{int(k), PathSample::before_path, parameter_at(progress[k]), progress[k]};
    sample.actuation = progress[k];
    if (progress[k] > 0 || !rests_flat(path.simulation.scene())) {
      const auto segment = segment_at(path, sample.t);
      // for a sample that the path did not reach, the end of its last segment is shown
      const bool past = !path.segments.empty() && sample.t > path.segments.back().end();
      if (!segment && !past) continue;
      sample.segment = segment.value_or(path.segments.size() - 1);
    }
    samples.push_back(sample);
  }
  return samples;
}

/// follow_actuation() as the mesh policy calls it.
Follow following(const std::shared_ptr<const Scene>& scene, bool inner, double to,
                 const RunContext& context) {
  return [=](const LevelPlan& plan, const Watch& watch) {
    return follow_actuation(scene, plan, inner, to, watch, context);
  };
}

}  // namespace

Result<EquilibriumPath> follow_actuation(const std::shared_ptr<const Scene>& scene,
                                         const LevelPlan& plan, bool inner, double to,
                                         const Watch& watch, const RunContext& context) {
  const double started = seconds_now();
  TRY(simulation, Simulation::open(scene, plan, context));
  EquilibriumPath path{std::move(*simulation)};
  path.seconds_setup = seconds_now() - started;
  const auto certified = [](const Result<Report>& first, const char* which) -> Result<void> {
    if (!first) return tl::unexpected<Error>(first.error());
    if (first->end == Outcome::reached) return {};
    return fail(Fault::no_equilibrium, "{} is not certified: {}", which, words_of(first->end).what);
  };
  const NestedShell& shell = path.simulation.shell();
  if (begins_as_drawn(*scene, shell.finest(), shell.motion())) {
    TRY(begun, certified(path.simulation.begin_as_drawn(watch), "the network as drawn"));
    follow_segment(path, parameter_at(to), {}, watch);
  } else if (to == 0) {
    (void)path.simulation.begin_flat();  // always an equilibrium
    return path;
  } else if (scene->from_net) {
    TRY(begun, certified(path.simulation.begin_on_net(watch), "the state next to the net"));
    const Checkpoint start = path.simulation.save();
    if (inner) {
      follow_back(path, {}, watch);
      path.simulation.restore(start);
    }
    follow_segment(path, 1, {}, watch);
  } else {
    TRY(start, begin_from_flat(path, watch));
    if (!path.too_coarse()) follow_from_flat(path, *start, parameter_at(to), watch);
  }
  if (watch.cancelled()) return stopped();
  set_limit(path, watch);
  return path;
}

Result<EquilibriumPath> follow_whole_actuation(const std::shared_ptr<const Scene>& scene,
                                               const LevelPlan& plan, std::string_view purpose,
                                               const Watch& watch, const RunContext& context) {
  auto actuated = follow_actuation(scene, plan, false, 1, watch, context);
  if (!actuated) return actuated;
  // a path that ends as its mesh is too coarse is followed again
  if (!actuated->too_coarse())
    if (const std::string doubt = doubt_about(*actuated); !doubt.empty())
      actuated->doubt_before = "of the actuation: " + doubt;
  actuated->earlier = std::exchange(actuated->segments, {});
  for (PathSegment& segment : actuated->earlier) segment.free_states();
  if (actuated->too_coarse()) return actuated;
  // a shell that is formed may be used, even if how the flat state leads to it is not known
  const PathSegment& last = actuated->earlier.back();
  const bool formed = !last.back && last.report.end == Outcome::reached;
  if (actuated->limit != record::Limit::none && actuated->limit != record::Limit::snap && !formed)
    return fail(Fault::no_equilibrium, "there is no actuated shell {}: {}{}", purpose,
                actuated->limit_reason,
                actuated->limit == record::Limit::locking
                    ? "; a larger actuated boundary, or more [limits] max_strain, goes further"
                    : "");
  return actuated;
}

Result<EquilibriumPath> converged_actuation(const std::shared_ptr<const Scene>& scene, bool inner,
                                            double to, const Watch& watch,
                                            const RunContext& context) {
  auto path = converged_path(*scene, following(scene, inner, to, context), watch);
  if (path) set_limit(*path, watch);
  return path;
}

Result<EquilibriumPath> run_actuation(std::shared_ptr<const Scene> scene,
                                      const std::vector<double>& progress, record::Sink& sink,
                                      Watch& watch, const RunContext& context) {
  const bool inner = std::ranges::any_of(progress, [](double p) { return p > 0 && p < 1; });
  return run_experiment(
      *scene, following(scene, inner, progress.back(), context),
      [&](const EquilibriumPath& path) { return samples_at(path, progress); }, sink, watch);
}

}  // namespace gridshell::simulate
