#include "engine/experiment/indentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/experiment/actuation.h"
#include "engine/experiment/frames.h"
#include "engine/measure/displacement.h"
#include "engine/measure/gauss.h"
#include "engine/scene/net_design.h"
#include "engine/solve/arc.h"

namespace gridshell::experiment {
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

Result<PushOf> push_of(const preset::Indentation& asked, const Scene& scene, const RodMesh& mesh,
                       const Eigen::Matrix3Xd& nodes) {
  const Eigen::Index joints = Eigen::Index(scene.footprint.joints.size());
  Eigen::Matrix3Xd places = nodes.leftCols(joints);
  if (scene.net) {
    auto net = points_on(*scene.net, mesh.flat.leftCols(joints));
    if (!net) return tl::unexpected<Error>(net.error());
    places = std::move(*net);
  }
  const auto joint = pushed_joint(asked, scene.footprint, places);
  if (!joint) return tl::unexpected<Error>(joint.error());
  PushOf push{*joint};
  if (scene.net) {
    const FootprintJoint& at = scene.footprint.joints[std::size_t(*joint)];
    const auto point = scene.net->at(at.u, at.v);
    if (!point) return tl::unexpected<Error>(point.error());
    push.displacement = point->normal();
  } else {
    const JointTangents tangents = joint_tangents(scene.footprint, mesh, nodes);
    push.displacement = tangents.u.col(*joint).cross(tangents.v.col(*joint)).normalized();
  }
  const double depth = asked.depth_mm > 0 ? asked.depth_mm : asked.depth * scene.length_scale_mm;
  push.displacement *= asked.direction == preset::Direction::inward ? -depth : depth;
  return push;
}

namespace {

/// One push of one shell, with what its frames need to know.
struct Pushed {
  Course course;
  PushOf push;
  double depth_mm = 0;
  Eigen::Matrix3Xd before;  // joints of the unloaded shell
};

std::string at_depth(double depth_mm, double t) {
  return fmt::format("at depth {:.3f} mm", t * depth_mm);
}

/// Where the path that was lost turns back, as the arc length says.
std::string turning_back(Session& session, const Leg& leg, double depth_mm, const Watch& watch) {
  if (leg.report.events.empty()) return {};
  const Event& event = leg.report.events.front();
  const Station* last = nullptr;
  const double way = leg.to > leg.from ? 1 : -1;
  for (const Station& station : leg.trail.stations)
    if (way * (event.t - station.point.t) >= 0) last = &station;
  if (!last) return {};
  const ArcOptions fine{.step_mm = 0.05, .largest_mm = 0.2, .parameter_mm = depth_mm};
  const auto turn = turning_point(session.shell().system(0), session.shell().motion(0), last->point,
                                  way, fine, watch);
  return turn ? fmt::format(" (its path turns back at {:.3f} mm)", *turn * depth_mm)
              : std::string();
}

/// Why the push stopped, or what it came past.
void tell(Pushed& pushed, const Leg& leg, const Watch& watch) {
  const auto at = [&](double t) { return at_depth(pushed.depth_mm, t); };
  Course& course = pushed.course;
  tell_limit(course, leg, at);
  const Scene& scene = course.session.scene();
  if (course.limit == record::Limit::snap)
    course.limit_reason = fmt::format(
        "held at the joint, the shell lost its {} {}{} and came to rest in another state",
        leg.report.events.front().kind == Event::Kind::stability_lost ? "stability" : "equilibrium",
        at(leg.report.events.front().t), turning_back(course.session, leg, pushed.depth_mm, watch));
  if (course.limit == record::Limit::locking)
    course.limit_reason =
        fmt::format("{} ({:.4f} of the length scale) and {:.4g} N the rods are at their length: {}",
                    at(leg.report.t), leg.report.t * pushed.depth_mm / scene.length_scale_mm,
                    pushed.push.displacement.normalized().dot(course.session.force(0)),
                    leg.report.certificate.largest_strain > 0.99 * scene.max_strain
                        ? fmt::format("the largest strain reaches {:g}", scene.max_strain)
                        : "the push meets 100 times its first stiffness");
}

Result<Pushed> follow_push(const std::shared_ptr<const Scene>& scene,
                           const preset::Indentation& asked, const LevelPlan& plan,
                           const Watch& watch) {
  auto actuated = follow_actuation(scene, plan, false, 1, watch);
  if (!actuated) return tl::unexpected<Error>(actuated.error());
  if (actuated->limit != record::Limit::none && actuated->limit != record::Limit::snap)
    return fail(Fault::no_equilibrium,
                "there is no actuated shell to push: " + actuated->limit_reason);
  Session& session = actuated->session;
  const auto push = push_of(asked, *scene, session.shell().finest(), session.nodes());
  if (!push) return tl::unexpected<Error>(push.error());
  Pushed pushed{std::move(*actuated), *push, push->displacement.norm(), {}};
  Course& course = pushed.course;
  pushed.before = course.session.nodes().leftCols(Eigen::Index(scene->footprint.joints.size()));
  course.legs.clear();
  course.limit = record::Limit::none;
  Hold hold{push->joint};
  if (asked.lateral == preset::Lateral::free) hold.directions = push->displacement.normalized();
  const Report held = course.session.take_hold({hold}, {push->displacement}, watch);
  if (held.end != Outcome::reached)
    return fail(Fault::no_equilibrium, "the unloaded shell cannot be held at the joint pushed");
  for (double to : asked.unload ? std::vector<double>{1, 0} : std::vector<double>{1}) {
    Leg leg{course.session.shell().state().t, to, {}, {}};
    leg.report = course.session.go(to, watch, {}, &leg.trail);
    course.legs.push_back(std::move(leg));
    if (watch.cancelled()) return fail(Fault::cancelled, "stopped");
    if (course.limit == record::Limit::none) tell(pushed, course.legs.back(), watch);
    if (course.legs.back().report.end != Outcome::reached) break;
  }
  return pushed;
}

record::Frame frame_at(Pushed& pushed, double t) {
  const Session& session = pushed.course.session;
  record::Frame frame = frame_of(session);
  frame.actuation = 1;
  frame.boundary_radius_mm = session.scene().radius_end_mm;
  frame.depth_mm = t * pushed.depth_mm;
  frame.force_N = pushed.push.displacement.normalized().dot(session.force(0));
  const Reach reach =
      reach_of(pushed.before, frame.nodes.leftCols(pushed.before.cols()), frame.depth_mm);
  frame.reach_above_tenth = reach.above_tenth;
  frame.reach_above_half = reach.above_half;
  frame.lowest_latitude_deg = reach.lowest_latitude_deg;
  return frame;
}

/// What happened on a leg between two path parameters.
std::string event_between(const Leg& leg, double before, double t, double depth_mm) {
  const double way = leg.to > leg.from ? 1 : -1;
  for (const Event& event : leg.report.events)
    if (event.to && way * (*event.to - before) > 0 && way * (t - *event.to) >= 0)
      return fmt::format("snap at depth {:.2f} mm", event.t * depth_mm);
  return {};
}

/// Frames of a leg's samples, and of its limit.
class PushFrames {
 public:
  PushFrames(Pushed& pushed, record::Sink& sink, Watch& watch, std::size_t count)
      : pushed_(pushed), sink_(sink), watch_(watch), count_(count) {}

  Result<bool> at(std::size_t index, std::size_t leg, double t, double progress) {
    Course& course = pushed_.course;
    const Leg& way = course.legs[leg];
    const double end = way.trail.stations.back().point.t;
    const bool beyond = (way.to > way.from) ? t > end : t < end;
    if (beyond) return false;
    const int before = course.session.effort().newton_iterations;
    const Report report = stand_at(course, {int(index), leg, t}, watch_);
    if (watch_.cancelled()) return fail(Fault::cancelled, "stopped");
    if (report.end != Outcome::reached) {
      course.limit = record::Limit::branch_lost;
      course.limit_reason =
          fmt::format("{} {}", words_of(report.end).what, at_depth(pushed_.depth_mm, t));
      return false;
    }
    if (auto moved = motion(way, leg, t, progress); !moved)
      return tl::unexpected<Error>(moved.error());
    record::Frame frame = frame_at(pushed_, t);
    frame.newton_iterations = course.session.effort().newton_iterations - before;
    frame.event = event_between(way, leg == leg_ ? last_t_ : way.from, t, pushed_.depth_mm);
    if (frame.event.empty() && frame.negative_pivots > 0)
      frame.event = fmt::format("unstable: {} negative pivots", frame.negative_pivots);
    leg_ = leg;
    last_t_ = t;
    if (auto taken = take(std::move(frame), index, progress); !taken)
      return tl::unexpected<Error>(taken.error());
    return true;
  }

  /// The state in which the rods came to their length.
  Result<void> limit(const Checkpoint& end, std::size_t index, double progress) {
    pushed_.course.session.restore(end);
    pushed_.course.session.shell().back_to(end.state);
    record::Frame frame = frame_at(pushed_, end.state.t);
    frame.event = "locking";
    return take(std::move(frame), index, progress);
  }

 private:
  Result<void> motion(const Leg& leg, std::size_t number, double t, double progress) {
    if (number != leg_) next_snap_ = 0;
    const double way = leg.to > leg.from ? 1 : -1;
    bool any = false;
    for (; next_snap_ < leg.trail.snaps.size(); ++next_snap_) {
      const Trail::Snap& snap = leg.trail.snaps[next_snap_];
      const double landed = leg.trail.stations[snap.before + 1].point.t;
      if (way * (t - landed) < 0) break;
      any = true;
      for (record::Frame& frame : frames_in_motion(pushed_.course.session, snap.moments)) {
        frame.actuation = 1;
        frame.boundary_radius_mm = pushed_.course.session.scene().radius_end_mm;
        frame.depth_mm = landed * pushed_.depth_mm;
        if (auto taken = take(std::move(frame), 0, progress); !taken) return taken;
      }
    }
    if (any) stand_at(pushed_.course, {0, number, t}, watch_);
    return {};
  }

  Result<void> take(record::Frame frame, std::size_t index, double progress) {
    frame.index = pushed_.course.session.scene().snap.wanted ? taken_ : int(index);
    frame.progress = progress;
    ++taken_;
    watch_.report(0.5 + 0.5 * double(taken_) / double(count_));
    return sink_.take(std::move(frame));
  }

  Pushed& pushed_;
  record::Sink& sink_;
  Watch& watch_;
  std::size_t count_, next_snap_ = 0, leg_ = 0;
  double last_t_ = 0;
  int taken_ = 0;
};

}  // namespace

Result<Course> run_indentation(std::shared_ptr<const Scene> scene,
                               const preset::Indentation& indentation,
                               const std::vector<double>& progress, record::Sink& sink,
                               Watch& watch) {
  std::optional<Pushed> kept;
  auto course = course_of(
      *scene,
      [&](const LevelPlan& plan, const Watch& w) -> Result<Course> {
        auto pushed = follow_push(scene, indentation, plan, w);
        if (!pushed) return tl::unexpected<Error>(pushed.error());
        kept.emplace(std::move(*pushed));
        return std::move(kept->course);
      },
      watch);
  if (!course) return course;
  kept->course = std::move(*course);
  auto layout = layout_of(*scene, kept->course.session.shell().finest());
  if (!layout) return tl::unexpected<Error>(layout.error());
  if (auto begun = sink.begin(std::move(*layout)); !begun)
    return tl::unexpected<Error>(begun.error());
  const Checkpoint end = kept->course.session.save();
  PushFrames frames(*kept, sink, watch, progress.size());
  for (std::size_t k = 0; k < progress.size(); ++k) {
    const bool back = indentation.unload && progress[k] > 0.5;
    const double t = !indentation.unload ? progress[k]
                     : back              ? 2 * (1 - progress[k])
                                         : 2 * progress[k];
    Result<bool> taken = false;
    if (!back || kept->course.legs.size() > 1) taken = frames.at(k, back ? 1 : 0, t, progress[k]);
    if (!taken) return tl::unexpected<Error>(taken.error());
    if (*taken) continue;
    if (kept->course.limit == record::Limit::locking)
      if (auto last = frames.limit(end, k, progress[k]); !last)
        return tl::unexpected<Error>(last.error());
    break;
  }
  return std::move(kept->course);
}

}  // namespace gridshell::experiment
