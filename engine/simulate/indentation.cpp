#include "engine/simulate/indentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/try.h"
#include "engine/record/shape_measures.h"
#include "engine/scene/net_design.h"
#include "engine/simulate/actuation.h"
#include "engine/simulate/frames.h"
#include "engine/simulate/path_sampler.h"

namespace gridshell::simulate {
namespace {

Eigen::Vector3d direction_of(const preset::Indentation& indentation) {
  const double degree = M_PI / 180, latitude = degree * indentation.latitude_deg,
               longitude = degree * indentation.longitude_deg;
  return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
          std::sin(latitude)};
}

/// Index of the joint with the largest score; of equal ones that with the smallest (i, j).
int best_joint(const Footprint& footprint, const Eigen::VectorXd& score) {
  const double equal = 1e-9 * score.cwiseAbs().maxCoeff();
  int best = 0;
  for (int k = 1; k < int(footprint.joints.size()); ++k) {
    const FootprintJoint &a = footprint.joints[k], &b = footprint.joints[best];
    const bool before = std::pair(a.i, a.j) < std::pair(b.i, b.j);
    if (score[k] > score[best] + equal || (before && score[k] > score[best] - equal)) best = k;
  }
  return best;
}

At at_depth(double depth_mm) {
  return [depth_mm](double t, std::optional<double> error) {
    if (!error) return fmt::format("at depth {:.3f} mm", t * depth_mm);
    const double off = *error * depth_mm;
    const int digits = off > 0 ? int(std::clamp(-std::floor(std::log10(off)), 0.0, 3.0)) : 3;
    return fmt::format("at depth {:.{}f} mm ± {:.1g} mm", t * depth_mm, digits, off);
  };
}

Result<EquilibriumPath> follow_push(const std::shared_ptr<const Scene>& scene,
                                    const preset::Indentation& requested, const LevelPlan& plan,
                                    const Watch& watch, const RunContext& context) {
  auto pushed = prepare_push(scene, requested, plan, watch, context);
  if (pushed && pushed->too_coarse()) return pushed;
  for (double to : requested.unload ? std::vector<double>{1, 0} : std::vector<double>{1}) {
    if (!pushed) break;
    const PathSegment& segment = follow_segment(*pushed, to, {}, watch);
    if (watch.cancelled()) return stopped();
    if (segment.report.end != Outcome::reached) break;
  }
  return pushed;
}

/// The sample of the push at a frame's progress.
PathSample sample_of(std::size_t index, double progress, bool unload) {
  if (!unload) return {int(index), 0, progress, progress};
  const bool back = progress > 0.5;
  return {int(index), back ? 1u : 0u, back ? 2 * (1 - progress) : 2 * progress, progress};
}

/// Adds the load steps of the path to its samples, so that a curve through them turns where the
/// path does. The step at a limit has a frame of its own.
void add_load_steps(const EquilibriumPath& path, std::vector<PathSample>& samples) {
  constexpr double equal = 1e-9;
  for (std::size_t s = 0; s < path.segments.size(); ++s) {
    const PathSegment& segment = path.segments[s];
    for (const LoadStep& step : segment.load_steps) {
      if (&step == &segment.load_steps.back() && at_limit(segment.report.end)) continue;
      samples.push_back({0, s, step.point.t, progress_on(path, s, step.point.t)});
    }
  }
  std::ranges::stable_sort(samples, {}, &PathSample::progress);
  const auto same = [](const PathSample& a, const PathSample& b) {
    return b.progress - a.progress < equal;
  };
  samples.erase(std::unique(samples.begin(), samples.end(), same), samples.end());
  for (std::size_t k = 0; k < samples.size(); ++k) samples[k].index = int(k);
}

}  // namespace

Result<void> not_on_boundary(const Footprint& footprint, int joint) {
  if (std::ranges::find(footprint.fixed_joints, joint) == footprint.fixed_joints.end() ||
      footprint.is_sprung(joint))
    return {};
  const FootprintJoint& at = footprint.joints[std::size_t(joint)];
  return invalid("joint: got [{}, {}], which is a support, expected a free joint", at.i, at.j);
}

Result<int> pushed_joint(const preset::Indentation& indentation, const Footprint& footprint,
                         const Eigen::Matrix3Xd& joints) {
  if (!indentation.joint.empty())
    return joint_named(footprint, indentation.joint).map_error([](const Error& error) {
      return Error{error.fault, "[indentation] " + error.message};
    });
  const Eigen::VectorXd height = joints.row(2).transpose();
  if (indentation.at == preset::IndentationPosition::highest && indentation.latitude_deg == 90)
    return best_joint(footprint, height);
  return best_joint(footprint,
                    joints.colwise().normalized().transpose() * direction_of(indentation));
}

Result<Push> push_of(const preset::Indentation& requested, const Scene& scene,
                     const NestedShell& shell) {
  const Eigen::Index joints = Eigen::Index(scene.footprint.joints.size());
  Push push{.before = shell.state().x.leftCols(joints), .unload = requested.unload};
  Eigen::Matrix3Xd positions = push.before;
  if (scene.net) {
    TRY(net, points_on(*scene.net, shell.finest().flat.leftCols(joints)));
    positions = std::move(*net);
  }
  TRY(joint, pushed_joint(requested, scene.footprint, positions));
  TRY_DO(not_on_boundary(scene.footprint, *joint));
  push.joint = *joint;
  if (scene.net) {
    const FootprintJoint& at = scene.footprint.joints[std::size_t(*joint)];
    TRY(point, scene.net->at(at.u, at.v));
    push.displacement = point->normal();
  } else {
    push.displacement = joint_normal(scene.footprint, shell, *joint);
    if (push.displacement.isZero(0))
      return invalid(
          "[indentation]: no two rods cross at the joint pushed, so the "
          "shell has no normal there");
  }
  const double depth =
      requested.depth_mm > 0 ? requested.depth_mm : requested.depth * scene.length_scale_mm;
  push.displacement *= requested.direction == preset::Direction::inward ? -depth : depth;
  return push;
}

Result<EquilibriumPath> prepare_push(const std::shared_ptr<const Scene>& scene,
                                     const preset::Indentation& requested, const LevelPlan& plan,
                                     const Watch& watch, const RunContext& context) {
  auto pushed = follow_whole_actuation(scene, plan, "to push", watch, context);
  if (!pushed || pushed->too_coarse()) return pushed;
  TRY(push, push_of(requested, *scene, pushed->simulation.shell()));
  pushed->at = at_depth(push->depth_mm());
  const Across across = requested.lateral == preset::Lateral::free ? Across::free : Across::fixed;
  const Report taken =
      pushed->simulation.begin_push(push->joint, push->displacement, across, watch);
  if (taken.end != Outcome::reached)
    return fail(Fault::no_equilibrium,
                "the unloaded shell has no equilibrium with the pushed joint fixed");
  pushed->loaded_joints = {{push->joint, push->displacement.normalized()}};
  pushed->push = std::move(*push);
  return pushed;
}

void put_push(const EquilibriumPath& path, record::Frame& frame, double t, bool interpolated) {
  if (!path.push) return path.simulation.put_push(frame);
  const Push& push = *path.push;
  const Eigen::Vector3d force =
      interpolated ? frame.reactions_N.col(push.joint) : path.simulation.force(0);
  frame.force_N = push.displacement.normalized().dot(force);
  if (!interpolated) path.simulation.put_push_errors(frame);
  const PushReach reach =
      push_reach(push.before, frame.nodes.leftCols(push.before.cols()), t * push.depth_mm());
  frame.reach_above_tenth = reach.above_tenth;
  frame.reach_above_half = reach.above_half;
  frame.lowest_latitude_deg = reach.lowest_latitude_deg;
}

Result<EquilibriumPath> run_indentation(std::shared_ptr<const Scene> scene,
                                        const preset::Indentation& indentation,
                                        const std::vector<double>& progress, bool own_steps,
                                        record::Sink& sink, Watch& watch,
                                        const RunContext& context) {
  return run_experiment(
      *scene,
      [&](const LevelPlan& plan, const Watch& w) {
        return follow_push(scene, indentation, plan, w, context);
      },
      [&](const EquilibriumPath& path) {
        std::vector<PathSample> samples;
        for (std::size_t k = 0; k < progress.size(); ++k)
          samples.push_back(sample_of(k, progress[k], indentation.unload));
        if (own_steps) add_load_steps(path, samples);
        return samples;
      },
      sink, watch);
}

}  // namespace gridshell::simulate
