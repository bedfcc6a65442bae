#include "engine/experiment/indentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/clock.h"
#include "engine/experiment/frames.h"
#include "engine/experiment/net_design.h"
#include "engine/experiment/snap.h"
#include "engine/measure/displacement.h"
#include "engine/measure/gauss.h"
#include "engine/solve/arc.h"

namespace gridshell::experiment {
namespace {

constexpr double load_step = 0.02;         // of the length scale, at most
constexpr double stiffness_growth = 100;   // at which the rods are at their length
constexpr double smallest_step_mm = 5e-3;  // to which a limit is located

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

class Push {
 public:
  Push(const ActuationScene& scene, const preset::Indentation& asked, ActuationOutcome actuated,
       Watch& watch)
      : scene_(scene),
        asked_(asked),
        watch_(watch),
        outcome_(std::move(actuated)),
        shell_(*outcome_.shell),
        unloaded_(outcome_.trajectory.frames.back()) {}

  Result<ActuationOutcome> run(const std::vector<double>& progress) {
    const double begin = seconds_now();
    const Effort before = shell_.effort();
    count_ = before.newton_iterations;
    if (auto failure = take_hold()) return tl::unexpected<Error>(*failure);
    outcome_.trajectory.frames.clear();
    for (std::size_t k = 0; k < progress.size(); ++k) {
      const double t = depth_at(progress[k]);
      // a snap may have come to rest beyond
      if (k > 0 && (t - good_t_) * (t - depth_at(progress[k - 1])) < 0) continue;
      if (!go_to(t) && !at_limit_) break;
      if (watch_.cancelled()) return fail(Fault::cancelled, "stopped");
      if (shell_.state().t != t && !at_limit_) continue;
      add(int(k), progress[k]);
      if (at_limit_) break;
      watch_.report(double(k + 1) / double(progress.size()));
    }
    if (watch_.cancelled()) return fail(Fault::cancelled, "stopped");
    const Effort after = shell_.effort();
    outcome_.effort += {after.newton_iterations - before.newton_iterations,
                        after.factorizations - before.factorizations};
    outcome_.seconds_simulation += seconds_now() - begin;
    return std::move(outcome_);
  }

 private:
  /// Joint, normal and depth; from here on the path parameter t is the depth over the full one.
  std::optional<Error> take_hold() {
    const int last = shell_.levels() - 1, joints = shell_.mesh(0).joints;
    const record::Layout& layout = outcome_.trajectory.layout;
    const bool net = layout.net_nodes.size() > 0;
    before_ = unloaded_.nodes.leftCols(joints);
    places_ = net ? layout.net_nodes.leftCols(joints) : before_;
    const auto joint = pushed_joint(asked_, scene_.footprint, places_);
    if (!joint) return joint.error();
    joint_ = *joint;
    if (scene_.net) {
      const FootprintJoint& at = scene_.footprint.joints[std::size_t(joint_)];
      const auto point = scene_.net->at(at.u, at.v);
      if (!point) return point.error();
      along_ = point->normal();
    } else {
      const JointTangents tangents =
          joint_tangents(scene_.footprint, shell_.mesh(last), unloaded_.nodes);
      along_ = tangents.u.col(joint_).cross(tangents.v.col(joint_)).normalized();
    }
    if (asked_.direction == preset::Direction::inward) along_ = -along_;
    outcome_.trajectory.layout.loaded_joints = {{joint_, along_}};
    full_depth_ = asked_.depth_mm > 0 ? asked_.depth_mm : asked_.depth * scene_.length_scale_mm;
    Prescription held{joint_, Eigen::Matrix3Xd::Identity(3, 3)};
    if (asked_.lateral == preset::Lateral::free) held.directions = along_;
    shell_.push_joint(held, full_depth_ * along_);
    const NestedReport report = shell_.start(0, shell_.state().levels[0], watch_);
    if (report.end != NestedEnd::reached)
      return Error{Fault::no_equilibrium, "the unloaded shell cannot be held at the joint pushed"};
    keep();
    first_stiffness_ = stiffness();
    return std::nullopt;
  }

  double depth_at(double progress) const {
    if (!asked_.unload) return progress;
    return progress <= 0.5 ? 2 * progress : 2 * (1 - progress);
  }

  double depth_mm() const { return full_depth_ * shell_.state().t; }
  double force() const { return along_.dot(shell_.state().reaction); }
  double stiffness() const { return along_.dot(shell_.state().push_stiffness * along_); }
  bool locked() const {
    return shell_.state().largest_strain > scene_.max_strain ||
           stiffness() > stiffness_growth * first_stiffness_;
  }

  void keep() { good_ = shell_.state().levels[0], good_t_ = shell_.state().t; }
  bool back_to_good() { return shell_.start(good_t_, good_, watch_).end == NestedEnd::reached; }

  /// In load steps to t, or beyond where a snap carries it; false where the run stops.
  bool go_to(double t) {
    const double largest = load_step * scene_.length_scale_mm / full_depth_;
    const double way = t > good_t_ ? 1 : -1;
    while (way * (t - good_t_) > 0 && !watch_.cancelled()) {
      const int steps = std::max(1, int(std::ceil(std::abs(t - good_t_) / largest - 1e-9)));
      const double next = steps == 1 ? t : good_t_ + (t - good_t_) / steps;
      const NestedReport report = shell_.advance(next, watch_);
      if (watch_.cancelled()) return false;
      if (report.end != NestedEnd::reached && !snap(way, report.end)) return false;
      if (locked()) return stop_at_lock(shell_.state().t);
      keep();
    }
    return true;
  }

  /// Between the last good state and t the rods run into their length: finds where.
  bool stop_at_lock(double beyond) {
    at_limit_ = true;
    double bad = beyond;
    while (std::abs(bad - good_t_) * full_depth_ > smallest_step_mm && back_to_good()) {
      const double middle = 0.5 * (good_t_ + bad);
      if (shell_.advance(middle, watch_).end == NestedEnd::reached && !locked())
        keep();
      else
        bad = middle;
    }
    back_to_good();
    outcome_.limit = record::Limit::locking;
    outcome_.limit_reason = fmt::format(
        "at depth {:.3f} mm ({:.4f} of the length scale) and {:.4g} N the rods are at their "
        "length: {}",
        depth_mm(), depth_mm() / scene_.length_scale_mm, force(),
        shell_.state().largest_strain > 0.99 * scene_.max_strain
            ? fmt::format("the largest strain reaches {:g}", scene_.max_strain)
            : fmt::format("the push meets {:g} times its first stiffness", stiffness_growth));
    event_ = "locking";
    return false;
  }

  /// In time where that is asked for, else down the energy.
  Result<State> leave(const PathPoint& last, double there) {
    moving_.clear();
    if (scene_.snap.wanted) {
      auto rest = snap_in_time(scene_, shell_, there, watch_, moving_);
      for (record::Frame& frame : moving_) frame.depth_mm = there * full_depth_;
      if (rest || watch_.cancelled()) return rest;
    }
    return leave_branch(shell_.system(0), shell_.motion(0), last, there, watch_);
  }

  /// Frames of a snap stand before the one that it ends in.
  void add_motion(double progress) {
    for (record::Frame& frame : moving_) {
      frame.index = int(outcome_.trajectory.frames.size());
      frame.progress = progress;
      frame.actuation = 1;
      frame.boundary_radius_mm = scene_.radius_end_mm;
      outcome_.trajectory.frames.push_back(std::move(frame));
    }
    moving_.clear();
  }

  /// Whether the branch goes on back from where it was lost, as the arc length says.
  std::string turning_back(double way) {
    const ArcOptions fine{.step_mm = 0.05, .largest_mm = 0.2, .parameter_mm = full_depth_};
    const auto turn =
        turning_point(shell_.system(0), shell_.motion(0), {good_t_, good_, {}}, way, fine);
    return turn ? fmt::format(" (its path turns back at {:.3f} mm)", *turn * full_depth_)
                : std::string();
  }

  /// The branch ended: comes to rest again a little further on. The meshes lose it at slightly
  /// different depths; beyond the last of them all find the new state.
  bool snap(double way, NestedEnd lost) {
    const PathPoint last = shell_.followed();
    const double at = last.t * full_depth_;
    const std::string turned = turning_back(way);
    for (double beyond = 1e-3; beyond < 0.1; beyond *= 2) {
      const double there = last.t + way * beyond * scene_.length_scale_mm / full_depth_;
      if (there < 0 || there > 1) break;
      const auto rest = leave(last, there);
      if (watch_.cancelled()) return false;
      if (!rest || shell_.start(there, *rest, watch_).end != NestedEnd::reached) continue;
      event_ = fmt::format("snap at depth {:.2f} mm", at);
      if (outcome_.limit == record::Limit::none) {
        outcome_.limit = record::Limit::snap;
        outcome_.limit_reason = fmt::format(
            "held at the joint, the shell lost its {} at depth {:.3f} mm{} and came to rest in "
            "another state",
            lost == NestedEnd::unstable ? "stability" : "equilibrium", at, turned);
      }
      return true;
    }
    outcome_.limit = record::Limit::branch_lost;
    outcome_.limit_reason = fmt::format("no rest was found beyond depth {:.3f} mm", at);
    return false;
  }

  void add(int index, double progress) {
    add_motion(progress);
    record::Frame frame = frame_of(scene_, shell_);
    frame.index = scene_.snap.wanted ? int(outcome_.trajectory.frames.size()) : index;
    frame.progress = progress;
    frame.actuation = 1;
    frame.boundary_radius_mm = scene_.radius_end_mm;
    frame.depth_mm = depth_mm();
    frame.force_N = force();
    const Reach reach = reach_of(before_, frame.nodes.leftCols(before_.cols()), depth_mm());
    frame.reach_above_tenth = reach.above_tenth;
    frame.reach_above_half = reach.above_half;
    frame.lowest_latitude_deg = reach.lowest_latitude_deg;
    frame.event = std::exchange(event_, {});
    const int count = shell_.effort().newton_iterations;
    frame.newton_iterations = count - count_;
    count_ = count;
    outcome_.trajectory.frames.push_back(std::move(frame));
  }

  const ActuationScene& scene_;
  const preset::Indentation& asked_;
  Watch& watch_;
  ActuationOutcome outcome_;
  NestedShell& shell_;
  record::Frame unloaded_;
  Eigen::Matrix3Xd before_, places_;  // joints of the unloaded shell; on the net where there is one
  int joint_ = 0;
  Eigen::Vector3d along_ = Eigen::Vector3d::UnitZ();  // of the push
  double full_depth_ = 0, first_stiffness_ = 0;
  State good_;  // coarsest level of the last good state, at good_t_
  double good_t_ = 0;
  bool at_limit_ = false;
  std::string event_;
  std::vector<record::Frame> moving_;  // of a snap in time
  int count_ = 0;
};

}  // namespace

Result<int> pushed_joint(const preset::Indentation& indentation, const Footprint& footprint,
                         const Eigen::Matrix3Xd& joints) {
  if (indentation.joint.size() == 2) {
    for (std::size_t k = 0; k < footprint.joints.size(); ++k)
      if (footprint.joints[k].i == indentation.joint[0] &&
          footprint.joints[k].j == indentation.joint[1])
        return int(k);
    return fail(Fault::bad_input,
                fmt::format("[indentation] joint = [{}, {}]: the footprint has no such joint",
                            indentation.joint[0], indentation.joint[1]));
  }
  const Eigen::VectorXd height = joints.row(2).transpose();
  if (indentation.at == preset::IndentationPlace::highest && indentation.latitude_deg == 90)
    return best_joint(footprint, height);
  return best_joint(footprint,
                    joints.colwise().normalized().transpose() * direction_of(indentation));
}

Result<ActuationOutcome> run_indentation(const ActuationScene& scene,
                                         const preset::Indentation& indentation,
                                         const std::vector<double>& progress, Watch& watch) {
  ActuationScene refined = scene;
  Effort effort;
  double seconds = 0;
  for (;;) {
    auto actuated = run_actuation(refined, {1.0}, watch);
    if (!actuated) return actuated;
    if (actuated->limit != record::Limit::none || actuated->trajectory.frames.empty())
      return fail(Fault::no_equilibrium,
                  "there is no actuated shell to push: " + actuated->limit_reason);
    actuated->effort += effort;
    actuated->seconds_simulation += seconds;
    auto pushed = Push(refined, indentation, std::move(*actuated), watch).run(progress);
    if (!pushed || scene.levels_fixed) return pushed;
    // as in an actuation the last state decides, where errors are largest as a rule
    const double error = pushed->trajectory.frames.back().error_estimate_mm;
    if (!(error > scene.tolerance * scene.length_scale_mm)) return pushed;
    const auto plan = finer(pushed->levels);
    if (!plan)
      return fail(Fault::no_equilibrium,
                  fmt::format("the tolerance {:g} is not met: {} edges a segment leave an "
                              "estimated error of {:.2g} mm at the end of the push",
                              scene.tolerance, pushed->levels.edges_per_segment.back(), error));
    refined.levels = *plan;
    effort = pushed->effort;
    seconds = pushed->seconds_simulation;
  }
}

}  // namespace gridshell::experiment
