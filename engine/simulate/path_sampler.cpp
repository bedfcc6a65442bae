#include "engine/simulate/path_sampler.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/core/try.h"
#include "engine/simulate/frames.h"
#include "engine/simulate/frames_between.h"

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

}  // namespace

PathSampler::PathSampler(EquilibriumPath& path, Caption caption, record::Sink& sink, Watch& watch,
                         std::size_t count)
    : path_(path), caption_(std::move(caption)), sink_(sink), watch_(watch), count_(count) {}

Result<void> PathSampler::all(const std::vector<PathSample>& samples) {
  if (path_.segments.empty()) return {};
  const Checkpoint end = path_.simulation.save();
  const PathSegment& last = path_.segments.back();
  for (const PathSample& sample : samples) {
    if (came_to(path_, sample)) {
      TRY(taken, at(sample));
      if (*taken) continue;
    }
    if (!at_limit(last.report.end) || last.back) continue;
    path_.simulation.restore(end);
    // the path converges to its own tolerance, a frame to round-off
    if (path_.simulation.sample(end.state.t, last.load_steps.back(), false, watch_).end !=
        Outcome::reached)
      path_.simulation.restore(end);
    PathSample there{sample.index, path_.segments.size() - 1, end.state.t};
    there.progress = caption_.progress(there.segment, there.t);
    TRY_DO(take_current(there, limit_event(path_.simulation, last.report.end), there.t));
    break;
  }
  path_.simulation.restore(end);
  return {};
}

Result<bool> PathSampler::at(const PathSample& sample) {
  if (!between_) between_ = std::make_shared<FramesBetween>(path_, caption_.measure, watch_);
  // the final state is solved: its residual and stability are those of the result
  auto frame = sample.progress < 1 ? between_->at(sample) : std::nullopt;
  if (frame) {
    TRY_DO(motions(sample, sample.t));
    return take_at(std::move(*frame), sample, events(sample, sample.t), sample.t).map([] {
      return true;
    });
  }
  const int before = path_.simulation.effort().newton_iterations;
  const auto [report, past] = certify_sample(path_, sample, watch_);
  if (watch_.cancelled()) return stopped();
  if (report.end != Outcome::reached) {
    if (within_snap(path_.segments[sample.segment], sample.t)) {
      path_.limit_reason += "; there is no state to show " + path_.at(sample.t, {});
    } else if (path_.limit == record::Limit::none || path_.limit == record::Limit::snap) {
      path_.limit = record::Limit::branch_lost;
      path_.limit_reason = fmt::format("{} {}", words_of(report.end).what, path_.at(sample.t, {}));
    }
    return false;
  }
  TRY_DO(motions(sample, past));
  std::string event = events(sample, past);
  if (const int pivots = report.certificate.negative_pivots; event.empty() && pivots > 0)
    event = fmt::format("unstable: {} negative pivots", pivots);
  const int newton = path_.simulation.effort().newton_iterations - before;
  return take_current(sample, std::move(event), past, newton).map([] { return true; });
}

Result<void> PathSampler::take_current(const PathSample& sample, std::string event, double past,
                                       int newton_iterations) {
  record::Frame frame = frame_of(path_.simulation);
  caption_.measure(frame, sample.t, false);
  frame.newton_iterations = newton_iterations;
  return take_at(std::move(frame), sample, std::move(event), past);
}

Result<void> PathSampler::take_at(record::Frame frame, const PathSample& sample, std::string event,
                                  double past) {
  frame.event = std::move(event);
  // the frame before all steps belongs to no segment
  if (sample.segment < path_.segments.size() && at_event(path_.segments[sample.segment], sample.t))
    frame.error_estimate_mm = frame.force_error_N = frame.push_error_N = frame.energy_error_mJ =
        frame.stiffness_error_N_per_mm = record::unknown;
  last_ = sample;
  last_reached_t_ = past;
  return take(std::move(frame), sample);
}

Result<void> PathSampler::take(record::Frame frame, const PathSample& sample) {
  // if there may be frames of snaps between the samples, all frames are counted
  frame.index = path_.simulation.scene().snap.requested ? taken_ : sample.index;
  frame.progress = sample.progress;
  caption_.set_position(frame, sample.t, sample.progress);
  ++taken_;
  watch_.report(0.5 + 0.5 * double(taken_) / double(count_));
  return sink_.take(std::move(frame));
}

/// Passes the frames of the snaps of the segment since the previous sample.
Result<void> PathSampler::motions(const PathSample& sample, double past) {
  const PathSegment& segment = path_.segments[sample.segment];
  if (!last_ || last_->segment != sample.segment) next_snap_ = 0;
  std::optional<Checkpoint> here;
  for (; next_snap_ < segment.snaps.size(); ++next_snap_) {
    const PathRecord::Snap& snap = segment.snaps[next_snap_];
    const double landed = segment.load_steps[snap.before + 1].point.t;
    if (segment.sign() * (past - landed) < 0) break;
    // frames_in_motion() assembles other states in the simulation
    if (!here) here = path_.simulation.save();
    PathSample there = sample;
    there.t = landed;
    for (record::Frame& frame : frames_in_motion(path_.simulation, landed, snap.moments))
      if (auto taken = take(std::move(frame), there); !taken) return taken;
  }
  if (here) path_.simulation.restore(*here);
  return {};
}

/// Events of a sample. A segment back is shown in reverse, from its end to its start.
std::string PathSampler::events(const PathSample& sample, double past) const {
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
      passed += (passed.empty() ? "" : " and ") + path_.at(event.t, {});
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

}  // namespace gridshell::simulate
