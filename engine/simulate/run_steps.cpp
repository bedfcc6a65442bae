#include "engine/core/try.h"
#include "engine/simulate/steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "engine/simulate/actuation.h"
#include "engine/simulate/path_sampler.h"

namespace gridshell::simulate {
namespace {

using preset::StepKind;

/// Whether frames are sampled along the path of a step, which a segment then stores: for a push,
/// for a joint actuation, and for a move of the whole boundary if no edge point is displaced
/// individually before or after it.
bool has_path(const std::vector<preset::Step>& steps, std::size_t k) {
  if (steps[k].kind != StepKind::move)
    return steps[k].kind == StepKind::push || steps[k].kind == StepKind::open;
  const auto before = std::find_if(steps.rend() - std::ptrdiff_t(k), steps.rend(),
                                   [](const auto& step) { return step.kind == StepKind::move; });
  return steps[k].edge_points.empty() && (before == steps.rend() || before->edge_points.empty());
}

/// Completes the segment of a step. Without a path it has only the state at its end.
void close(PathSegment& segment, const Simulation& simulation) {
  if (!segment.load_steps.empty()) {
    segment.from = segment.load_steps.front().point.t;
    return;
  }
  segment.load_steps.push_back(
      {simulation.shell().point(), simulation.certificate(), simulation.contacts()});
  segment.from = segment.to = segment.end();
}

std::string at_fraction(double t, std::optional<double> error) {
  auto text = fmt::format("at {:.4f}", t);
  if (error) text += fmt::format(" ± {:.1g}", *error);
  return text + " of its path";
}

/// The shell before the steps. The bolts of the first step fix the joints as drawn if it opens the
/// joints of a network that has no regular equilibrium without them, as naturally straight strips
/// that close into a bundle, or if it prescribes the mean angle; `reported` then says so.
Result<EquilibriumPath> begin(const std::shared_ptr<const Scene>& scene,
                              const std::vector<preset::Step>& steps, const LevelPlan& plan,
                              const Watch& watch, const RunContext& context,
                              std::string& reported) {
  const bool opens = opens_as_drawn(steps, *scene);
  const bool mean = opens && steps.front().drive == preset::JointDrive::mean;
  Result<EquilibriumPath> loose = fail(Fault::no_equilibrium, "");
  if (!mean) loose = follow_whole_actuation(scene, plan, "to begin with", watch, context);
  if (loose || !opens || watch.cancelled()) return loose;
  TRY(bolts, bolts_as_drawn(steps.front(), scene->footprint));
  auto bolted = std::make_shared<Scene>(*scene);
  bolted->rods.bolts = std::make_shared<const Bolts>(std::move(*bolts));
  auto begun = follow_whole_actuation(bolted, plan, "to begin with", watch, context);
  if (mean) return begun;
  if (!begun)
    return fail(begun.error().fault, "{}; with the joints' springs as drawn {}",
                loose.error().message, begun.error().message);
  reported = "; its springs fixed the angles as drawn from the first state on, as without them " +
             loose.error().message;
  return begun;
}

/// Adds the joint of a push to the loaded joints, if it was moved.
void note_load(EquilibriumPath& path, const preset::Step& step) {
  const Simulation& simulation = path.simulation;
  const auto joint = joint_named(simulation.scene().footprint, step.joint);
  // a push that failed leaves no constraint
  const auto origin = simulation.constraint_origins.find(joint.value_or(-1));
  if (origin == simulation.constraint_origins.end()) return;
  const Eigen::Vector3d moved = simulation.nodes().col(*joint) - origin->second;
  if (moved.norm() > nearest_mm &&
      std::ranges::find(path.loaded_joints, *joint, &record::LoadedJoint::joint) ==
          path.loaded_joints.end())
    path.loaded_joints.push_back({*joint, moved.normalized(), true});
}

/// Applies the steps on the meshes of one plan, a segment each. The last segment of `earlier` has
/// the shell before them.
Result<EquilibriumPath> follow_steps(const std::shared_ptr<const Scene>& scene,
                                     const std::vector<preset::Step>& steps, const LevelPlan& plan,
                                     const Watch& watch, const RunContext& context) {
  std::string reported;
  auto path = begin(scene, steps, plan, watch, context, reported);
  if (!path || path->too_coarse()) return path;
  path->at = at_fraction;
  Simulation& simulation = path->simulation;
  path->earlier.back().after = simulation.save();
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const StepKind kind = steps[k].kind;
    const double to = kind == StepKind::move ? parameter_at(progress_of(steps[k], *scene)) : 1;
    PathSegment& segment = path->segments.emplace_back(PathSegment{{}, 0, to, {}});
    auto report = apply_step(simulation, steps[k], watch, &segment);
    if (watch.cancelled()) return stopped();
    if (!report) {
      std::string why = fmt::format("[[step]] {}: {}", k + 1, report.error().message);
      if (k == 0) return fail(report.error().fault, std::move(why));
      // the steps before it are kept
      path->segments.pop_back();
      path->refused = std::move(why);
      break;
    }
    segment.report = std::move(*report);
    close(segment, simulation);
    segment.after = simulation.save();
    segment.step = text_of(steps[k]);
    segment.sampled = has_path(steps, k);
    if (kind == StepKind::push) note_load(*path, steps[k]);
    if (kind == StepKind::open)
      segment.reported = ", " + text_of_opened(simulation) + (k == 0 ? reported : "");
    if (segment.report.end != Outcome::reached) break;
  }
  return path;
}

/// The shell before the steps, and as many samples of each step as frames_of_steps() gives.
std::vector<PathSample> samples_of(const EquilibriumPath& path,
                                   const std::vector<preset::Step>& steps, int frames) {
  const std::vector<int> shares = frames_of_steps(steps, frames);
  const int count = std::accumulate(shares.begin(), shares.end(), 0);
  std::vector<PathSample> samples{{0, PathSample::before_path, 1, 0}};
  double before = 1;  // progress of the boundary
  for (std::size_t k = 0; k < path.segments.size(); ++k) {
    const PathSegment& segment = path.segments[k];
    const double after = segment.after->progress;
    const bool moves = steps[k].kind == StepKind::move;
    for (int n = 1; n <= shares[k]; ++n) {
      const double part = double(n) / shares[k];
      const int index = int(samples.size());
      PathSample sample{index, k, segment.end(), double(index) / count};
      sample.ends_step = n == shares[k];
      if (!sample.ends_step)
        sample.t = moves ? parameter_at(before + part * (after - before))
                         : segment.from + part * (segment.end() - segment.from);
      sample.actuation =
          moves && segment.sampled && before != after ? progress_at(sample.t) : after;
      samples.push_back(sample);
    }
    before = after;
  }
  return samples;
}

}  // namespace

Result<void> check_steps(const std::vector<preset::Step>& steps, const Footprint& footprint) {
  std::set<std::vector<int>> constrained;
  std::set<preset::Released> strengthened;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const preset::Step& step = steps[k];
    const bool one = !step.joint.empty();
    if (one)
      if (auto joint = joint_named(footprint, step.joint); !joint)
        return fail(joint.error().fault,
                    fmt::format("[[step]] {} {}", k + 1, joint.error().message));
    if (step.kind == preset::StepKind::push || step.kind == preset::StepKind::hold)
      constrained.insert(step.joint);
    if (auto cells = cells_of(step, footprint); !cells)
      return fail(cells.error().fault, fmt::format("[[step]] {} {}", k + 1, cells.error().message));
    const auto edge_points = double(2 * footprint.rods.size());
    for (const auto& row : step.edge_points)
      if (row[0] >= edge_points)
        return invalid("[[step]] {} edge_points: got {:g}, expected 0 to {:g}", k + 1, row[0],
                       edge_points - 1);
    if (step.kind == preset::StepKind::brace && footprint.cells.empty())
      return invalid("[[step]] {}: the footprint has no cells to brace", k + 1);
    if (step.kind == preset::StepKind::tighten || step.kind == preset::StepKind::open)
      strengthened.insert(preset::Released::bolts);
    if (step.kind == preset::StepKind::brace) strengthened.insert(preset::Released::braces);
    if (step.kind != preset::StepKind::release) continue;
    if (step.what != preset::Released::joints) {
      if (strengthened.erase(step.what) > 0) continue;
      const bool bolts = step.what == preset::Released::bolts;
      return invalid("[[step]] {} what: got {}, expected a step {} before it that adds them", k + 1,
                     word_of(step.what), bolts ? "\"tighten\" or \"open\"" : "\"brace\"");
    }
    if (one ? !constrained.contains(step.joint) : constrained.empty())
      return invalid(
          "[[step]] {}: got no prescribed joint, expected a step \"push\" or \"hold\" before it",
          k + 1);
    if (one)
      constrained.erase(step.joint);
    else
      constrained.clear();
  }
  return {};
}

std::vector<int> frames_of_steps(const std::vector<preset::Step>& steps, int frames) {
  std::vector<int> shares(steps.size(), 1);
  int paths = 0;
  for (std::size_t k = 0; k < steps.size(); ++k) paths += has_path(steps, k);
  int left = frames - 1 - int(steps.size()), to_come = paths;
  for (std::size_t k = 0; k < steps.size() && left > 0; ++k) {
    if (!has_path(steps, k)) continue;
    const int more = (left + to_come - 1) / to_come;
    shares[k] += more;
    left -= more;
    --to_come;
  }
  return shares;
}

Result<EquilibriumPath> run_steps(const std::shared_ptr<const Scene>& scene,
                                  const std::vector<preset::Step>& steps, int frames,
                                  record::Sink& sink, Watch& watch, const RunContext& context) {
  TRY_DO(check_steps(steps, scene->footprint));
  return run_experiment(
      *scene,
      [&](const LevelPlan& plan, const Watch& w) {
        return follow_steps(scene, steps, plan, w, context);
      },
      [&](const EquilibriumPath& path) { return samples_of(path, steps, frames); }, sink, watch);
}

}  // namespace gridshell::simulate
