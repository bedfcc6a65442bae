// Frames of a course, one a sample, handed to a sink in order.
#pragma once

#include "engine/experiment/course.h"
#include "engine/record/sink.h"

namespace gridshell::experiment {

/// What an experiment says of its frames beyond the state itself.
struct Caption {
  At at;
  /// Puts in where the boundary and the push stand at path parameter t.
  std::function<void(record::Frame&, double t, double progress)> stand;
  /// Measures on a certified state: forces, reach.
  std::function<void(record::Frame&)> measure;
};

/// Certifies samples of a course, in the order in which they are shown, with what happened between
/// them: frames of snaps that were followed in time, events.
class Sampler {
 public:
  /// `count`: of the samples to come, for the progress.
  Sampler(Course& course, Caption caption, record::Sink& sink, Watch& watch, std::size_t count)
      : course_(course), caption_(std::move(caption)), sink_(sink), watch_(watch), count_(count) {}

  /// One sample. False: it is not certified, which becomes the course's limit; within a jump that
  /// already is the limit, the limit's reason says it. Errors: cancelled, the sink's.
  Result<bool> at(const Sample& sample);
  /// The state that the session stands in as a frame, with an event of its own; `past`: as of
  /// Stood.
  Result<void> stand(const Sample& sample, const std::string& event, double past);
  /// What happened to the leg since the sample before, in words; empty: nothing.
  std::string events(const Sample& sample, double past) const;
  /// A frame made elsewhere.
  Result<void> take(record::Frame frame, const Sample& sample);

 private:
  Result<void> motions(const Sample& sample, double past);

  Course& course_;
  Caption caption_;
  record::Sink& sink_;
  Watch& watch_;
  std::size_t count_, next_snap_ = 0;
  std::optional<Sample> last_;
  double last_past_ = 0;  ///< of the last sample, as of Stood
  int taken_ = 0;
};

}  // namespace gridshell::experiment
