#include "engine/simulate/path_sampler.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/core/try.h"
#include "engine/simulate/frames.h"
#include "engine/simulate/frames_between.h"
#include "engine/simulate/indentation.h"

namespace gridshell::simulate {
namespace {

/// Whether the path was followed as far as a sample.
bool came_to(const EquilibriumPath& path, const PathSample& sample) {
  if (sample.segment >= path.segments.size()) return false;
  const PathSegment& segment = path.segments[sample.segment];
  // nearer to the flat than the segment back was followed there are no events
  if (segment.back && segment.report.end == Outcome::reached) return true;
  return segment.sign() * (segment.end() - sample.t) >= 0;
}

/// Certifies samples of a path in the order in which they are shown and passes their frames to a
/// sink.
class PathSampler {
 public:
  PathSampler(EquilibriumPath& path, record::Sink& sink, Watch& watch)
      : path_(path),
        simulation_(path.simulation),
        between_(path, watch),
        sink_(sink),
        watch_(watch) {}

  Result<void> all(const std::vector<PathSample>& samples) {
    count_ = samples.size();
    const PathSegment* last = path_.segments.empty() ? nullptr : &path_.segments.back();
    for (const PathSample& sample : samples) {
      if (sample.segment == PathSample::before_path) {
        TRY_DO(before_path(sample));
        continue;
      }
      if (path_.of_steps()) {
        TRY_DO(of_step(sample));
        continue;
      }
      if (came_to(path_, sample)) {
        TRY(taken, on_path(sample));
        if (*taken) continue;
      }
      if (!at_limit(last->report.end) || last->back) continue;
      TRY_DO(at_end(sample.index));
      break;
    }
    go_to_end();
    if (left_out_ > 0)
      path_.limit_reason += fmt::format("{}{} of the frames of its steps have no certified state",
                                        path_.limit_reason.empty() ? "" : "; ", left_out_);
    // the path ended at the first state if its last segment leads back to the flat one
    if (last && last->back && !samples.empty() && samples.back().segment != PathSample::before_path)
      certify_sample(path_, samples.back(), watch_);
    return {};
  }

 private:
  /// Returns the simulation to the end of the path; one without segments is at the flat footprint.
  void go_to_end() {
    if (path_.segments.empty()) return;
    const PathSegment& last = path_.segments.back();
    simulation_.restore(last.after ? *last.after : *last.path_end);
  }

  /// Passes the flat footprint as a frame, or the shell before the steps.
  Result<void> before_path(const PathSample& sample) {
    if (path_.of_steps()) {
      simulation_.restore(*path_.earlier.back().after);
      return take_current(sample, "", sample.t);
    }
    record::Frame frame = flat_frame(simulation_);
    go_to_end();
    return take(std::move(frame), sample);
  }

  /// Passes the state after a step as a frame, or one of its path, if it can be certified.
  Result<void> of_step(const PathSample& sample) {
    const PathSegment& segment = path_.segments[sample.segment];
    if (sample.ends_step) {
      simulation_.restore(*segment.after);
      std::string event =
          at_limit(segment.report.end) ? limit_event(simulation_, segment.report.end)
          : segment.sampled            ? events(sample, sample.t)
                            : segment.step + (snapped(segment) ? ": snap to another state" : "");
      return take_current(sample, std::move(event), sample.t);
    }
    simulation_.restore(segment.path_end ? *segment.path_end : *segment.after);
    const auto [report, past] = certify_sample(path_, sample, watch_);
    if (watch_.cancelled()) return stopped();
    if (report.end != Outcome::reached) return ++left_out_, Result<void>{};
    return take_current(sample, events(sample, past), past);
  }

  /// Passes the state at the limit that ended the path as a frame.
  Result<void> at_end(int index) {
    const PathSegment& last = path_.segments.back();
    const double t = last.path_end->state.t;
    go_to_end();
    const double residual_N = simulation_.certificate().residual_N;
    // the path converges to its own tolerance, a frame to round-off
    if (simulation_.sample(t, last.load_steps.back(), false, watch_).end != Outcome::reached ||
        simulation_.certificate().residual_N > residual_N)
      go_to_end();
    PathSample there{index, path_.segments.size() - 1, t};
    there.progress = progress_on(path_, there.segment, t);
    if (!path_.push) there.actuation = there.progress;
    return take_current(there, limit_event(simulation_, last.report.end), t);
  }

  /// Passes the frame of a sample. Returns false if it cannot be certified.
  Result<bool> on_path(const PathSample& sample) {
    // the final state is solved: its residual and stability are those of the result
    if (auto frame = sample.progress < 1 ? between_.at(sample) : std::nullopt) {
      TRY_DO(motions(sample, sample.t));
      TRY_DO(take_at(std::move(*frame), sample, events(sample, sample.t), sample.t));
      return true;
    }
    const int before = simulation_.effort().newton_iterations;
    const auto [report, past] = certify_sample(path_, sample, watch_);
    if (watch_.cancelled()) return stopped();
    if (report.end != Outcome::reached) {
      if (within_snap(path_.segments[sample.segment], sample.t)) {
        path_.limit_reason += "; there is no state to show " + path_.at(sample.t, {});
      } else if (path_.limit == record::Limit::none || path_.limit == record::Limit::snap) {
        path_.limit = record::Limit::branch_lost;
        path_.limit_reason =
            fmt::format("{} {}", words_of(report.end).what, path_.at(sample.t, {}));
      }
      return false;
    }
    TRY_DO(motions(sample, past));
    std::string event = events(sample, past);
    if (const int pivots = report.certificate.negative_pivots; event.empty() && pivots > 0)
      event = fmt::format("unstable: {} negative pivots", pivots);
    const int newton = simulation_.effort().newton_iterations - before;
    TRY_DO(take_current(sample, std::move(event), past, newton));
    return true;
  }

  Result<void> take_current(const PathSample& sample, std::string event, double past,
                            int newton_iterations = 0) {
    record::Frame frame = frame_of(simulation_);
    put_push(path_, frame, sample.t, false);
    frame.newton_iterations = newton_iterations;
    return take_at(std::move(frame), sample, std::move(event), past);
  }

  Result<void> take_at(record::Frame frame, const PathSample& sample, std::string event,
                       double past) {
    frame.event = std::move(event);
    // the frame before all steps belongs to no segment
    if (sample.segment < path_.segments.size() &&
        at_event(path_.segments[sample.segment], sample.t))
      frame.error_estimate_mm = frame.force_error_N = frame.push_error_N = frame.energy_error_mJ =
          frame.stiffness_error_N_per_mm = record::unknown;
    last_ = sample;
    last_reached_t_ = past;
    return take(std::move(frame), sample);
  }

  Result<void> take(record::Frame frame, const PathSample& sample) {
    const Scene& scene = simulation_.scene();
    // if there may be frames of snaps between the samples, all frames are counted
    frame.index = scene.snap.requested ? taken_ : sample.index;
    frame.progress = sample.progress;
    frame.actuation = sample.actuation;
    frame.boundary_radius_mm = path_.push ? scene.radius_end_mm : scene.radius_at(sample.actuation);
    if (path_.push) frame.depth_mm = sample.t * path_.push->depth_mm();
    ++taken_;
    watch_.report(0.5 + 0.5 * double(taken_) / double(count_));
    return sink_.take(std::move(frame));
  }

  /// Passes the frames of the snaps of the segment since the previous sample.
  Result<void> motions(const PathSample& sample, double past) {
    const PathSegment& segment = path_.segments[sample.segment];
    if (!last_ || last_->segment != sample.segment) next_snap_ = 0;
    for (; next_snap_ < segment.snaps.size(); ++next_snap_) {
      const PathRecord::Snap& snap = segment.snaps[next_snap_];
      PathSample there = sample;
      there.t = segment.load_steps[snap.before + 1].point.t;
      if (segment.sign() * (past - there.t) < 0) break;
      for (record::Frame& frame : frames_in_motion(simulation_, there.t, snap.moments))
        TRY_DO(take(std::move(frame), there));
    }
    return {};
  }

  /// Events of a sample. A segment back is shown in reverse, from its end to its start.
  std::string events(const PathSample& sample, double past) const {
    const PathSegment& segment = path_.segments[sample.segment];
    const double sign = segment.back ? -segment.sign() : segment.sign();
    double before = segment.back ? segment.end() : segment.from;
    if (last_ && last_->segment == sample.segment) before = last_reached_t_;
    std::string text;
    // snaps come first, as pictures mark a frame by the start of its text
    for (const bool jump : {true, false}) {
      std::string passed;
      for (const Event& event : segment.report.events) {
        if (!event.to || event.jump != jump) continue;
        const double seen = segment.back ? event.t : *event.to;
        if (sign * (seen - before) <= 0 || sign * (past - seen) < 0) continue;
        passed += (passed.empty() ? "" : " and ") + path_.at_on(segment)(event.t, {});
      }
      if (!passed.empty())
        text += (text.empty() ? "" : "; ") + std::string(jump ? "snap " : "branches ") + passed;
    }
    for (const ContactEvent& event : path_.contacts) {
      if (event.segment != sample.segment) continue;
      if (sign * (event.t - before) <= 0 || sign * (past - event.t) < 0) continue;
      text += (text.empty() ? "" : "; ") + event.text;
    }
    return text;
  }

  EquilibriumPath& path_;
  Simulation& simulation_;
  FramesBetween between_;
  record::Sink& sink_;
  Watch& watch_;
  std::size_t count_ = 0, next_snap_ = 0;
  std::optional<PathSample> last_;
  double last_reached_t_ = 0;  // CertifiedSample::past of the last sample
  int taken_ = 0, left_out_ = 0;
};

}  // namespace

Result<EquilibriumPath> run_experiment(const Scene& scene, const Follow& follow,
                                       const ChooseSamples& choose, record::Sink& sink,
                                       Watch& watch) {
  auto path = converged_path(scene, follow, watch);
  if (!path) return path;
  set_limit(*path, watch);
  path->contacts = contact_events(*path);
  TRY(layout, layout_of(path->simulation));
  layout->loaded_joints = path->loaded_joints;
  TRY_DO(sink.begin(std::move(*layout)));
  TRY_DO(PathSampler(*path, sink, watch).all(choose(*path)));
  return path;
}

}  // namespace gridshell::simulate
