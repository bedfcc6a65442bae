// Frames of a path, one per sample, passed to a sink in order.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/record/trajectory.h"
#include "engine/simulate/equilibrium_path.h"

namespace gridshell::simulate {

class FramesBetween;

/// The values of a frame that an experiment adds to the state.
struct Caption {
  /// Progress of the experiment at path parameter t of a segment, from 0 to 1.
  std::function<double(std::size_t segment, double t)> progress;
  /// Writes the position of boundary and push at path parameter t.
  std::function<void(record::Frame&, double t, double progress)> set_position;
  /// Measures forces and reach on the certified current state of the simulation, or, `between` load
  /// steps, on the frame alone.
  std::function<void(record::Frame&, double t, bool between)> measure;
};

/// Certifies samples of a path, in the order in which they are shown, and adds what happened
/// between them: events, and frames of snaps that were followed in time.
class PathSampler {
 public:
  /// `count`: number of samples, for the reported progress.
  PathSampler(EquilibriumPath& path, Caption caption, record::Sink& sink, Watch& watch,
              std::size_t count);

  /// Passes the frames of the samples in order. If the path ended at a limit before a sample, the
  /// state at that limit is the last frame; other samples that the path did not reach have no
  /// frame. Afterwards the simulation is in the same state as before. Errors: cancelled, those of
  /// the sink.
  Result<void> all(const std::vector<PathSample>& samples);
  /// Passes the frame of one sample. Returns false if the sample cannot be certified. This becomes
  /// the path's limit or, within a snap that already is the limit, is added to its reason. Errors:
  /// cancelled, those of the sink.
  Result<bool> at(const PathSample& sample);
  /// Passes the current state of the simulation as a frame with the text `event`; `past`: as in
  /// CertifiedSample.
  Result<void> take_current(const PathSample& sample, std::string event, double past,
                            int newton_iterations = 0);
  /// Text on the events of the segment since the previous sample; empty: there are none.
  std::string events(const PathSample& sample, double past) const;
  /// Passes a frame that was computed by the caller.
  Result<void> take(record::Frame frame, const PathSample& sample);

 private:
  Result<void> motions(const PathSample& sample, double past);
  Result<void> take_at(record::Frame frame, const PathSample& sample, std::string event,
                       double past);

  EquilibriumPath& path_;
  Caption caption_;
  std::shared_ptr<FramesBetween> between_;
  record::Sink& sink_;
  Watch& watch_;
  std::size_t count_, next_snap_ = 0;
  std::optional<PathSample> last_;
  double last_reached_t_ = 0;  ///< CertifiedSample::past of the last sample
  int taken_ = 0;
};

}  // namespace gridshell::simulate
