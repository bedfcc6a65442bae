#include "engine/experiment/sampler.h"

#include <fmt/format.h>

#include "engine/experiment/frames.h"

namespace gridshell::experiment {

Result<bool> Sampler::at(const Sample& sample) {
  const int before = course_.session.effort().newton_iterations;
  const auto [report, past] = stand_at(course_, sample, watch_);
  if (watch_.cancelled()) return stopped();
  if (report.end != Outcome::reached) {
    if (in_a_jump(course_.legs[sample.leg], sample.t)) {
      course_.limit_reason += "; there is no state to show " + caption_.at(sample.t, {});
    } else if (course_.limit == record::Limit::none || course_.limit == record::Limit::snap) {
      course_.limit = record::Limit::branch_lost;
      course_.limit_reason =
          fmt::format("{} {}", words_of(report.end).what, caption_.at(sample.t, {}));
    }
    return false;
  }
  if (auto moved = motions(sample, past); !moved) return tl::unexpected<Error>(moved.error());
  record::Frame frame = frame_of(course_.session);
  caption_.measure(frame);
  frame.event = events(sample, past);
  if (frame.event.empty() && frame.negative_pivots > 0)
    frame.event = fmt::format("unstable: {} negative pivots", frame.negative_pivots);
  frame.newton_iterations = course_.session.effort().newton_iterations - before;
  if (auto taken = take(std::move(frame), sample); !taken)
    return tl::unexpected<Error>(taken.error());
  last_ = sample;
  last_past_ = past;
  return true;
}

Result<void> Sampler::stand(const Sample& sample, const std::string& event, double past) {
  record::Frame frame = frame_of(course_.session);
  caption_.measure(frame);
  frame.event = event;
  last_ = sample;
  last_past_ = past;
  return take(std::move(frame), sample);
}

Result<void> Sampler::take(record::Frame frame, const Sample& sample) {
  // with frames of a snap in between, all are counted
  frame.index = course_.session.scene().snap.wanted ? taken_ : sample.index;
  frame.progress = sample.progress;
  caption_.stand(frame, sample.t, sample.progress);
  ++taken_;
  watch_.report(0.5 + 0.5 * double(taken_) / double(count_));
  return sink_.take(std::move(frame));
}

/// Frames of snaps that the leg came past since the sample before.
Result<void> Sampler::motions(const Sample& sample, double past) {
  const Leg& leg = course_.legs[sample.leg];
  if (!last_ || last_->leg != sample.leg) next_snap_ = 0;
  bool any = false;
  for (; next_snap_ < leg.trail.snaps.size(); ++next_snap_) {
    const Trail::Snap& snap = leg.trail.snaps[next_snap_];
    const double landed = leg.trail.stations[snap.before + 1].point.t;
    if (leg.way() * (past - landed) < 0) break;
    any = true;
    Sample there = sample;
    there.t = landed;
    for (record::Frame& frame : frames_in_motion(course_.session, snap.moments))
      if (auto taken = take(std::move(frame), there); !taken) return taken;
  }
  // the session stood somewhere else for them
  if (any) stand_at(course_, sample, watch_);
  return {};
}

/// A leg back is shown against its way: from its end to where it began.
std::string Sampler::events(const Sample& sample, double past) const {
  const Leg& leg = course_.legs[sample.leg];
  const double way = leg.back ? -leg.way() : leg.way();
  double before = leg.back ? leg.end() : leg.from;
  if (last_ && last_->leg == sample.leg) before = last_past_;
  std::string text;
  for (const Event& event : leg.report.events) {
    if (!event.to) continue;
    const double seen = leg.back ? event.t : *event.to;
    if (way * (seen - before) <= 0 || way * (past - seen) < 0) continue;
    text += (text.empty() ? "snap " : " and ") + caption_.at(event.t, {});
  }
  return text;
}

}  // namespace gridshell::experiment
