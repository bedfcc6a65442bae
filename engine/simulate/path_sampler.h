// Frames of a path, one per sample, handed to a sink in order.
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
  At at;
  /// Progress of the experiment at path parameter t of a segment, from 0 to 1.
  std::function<double(std::size_t segment, double t)> progress;
  /// Writes the position of boundary and push at path parameter t.
  std::function<void(record::Frame&, double t, double progress)> place;
  /// Measures forces and reach on the certified current state of the simulation, or, `between` load
  /// steps, on the frame alone.
  std::function<void(record::Frame&, double t, bool between)> measure;
};

/// Certifies samples of a path, in the order in which they are shown, with what happened between
/// them: frames of snaps that were followed in time, events.
class PathSampler {
 public:
  /// `count`: of the samples to come, for the progress.
  PathSampler(EquilibriumPath& path, Caption caption, record::Sink& sink, Watch& watch,
              std::size_t count);

  /// The samples in order. Where the path ended at a limit before a sample, the state at that limit
  /// is the last frame; what else the path did not reach has no frame. The simulation is then in
  /// the state in which it was. Errors: cancelled, the sink's.
  Result<void> all(const std::vector<PathSample>& samples);
  /// One sample. False: it is not certified, which becomes the path's limit; within a jump that
  /// already is the limit, the limit's reason says it. Errors: cancelled, the sink's.
  Result<bool> at(const PathSample& sample);
  /// The current state of the simulation as a frame, with an event of its own; `past`: as in
  /// CertifiedSample.
  Result<void> take_current(const PathSample& sample, std::string event, double past,
                            int newton_iterations = 0);
  /// What happened to the segment since the sample before, in words; empty: nothing.
  std::string events(const PathSample& sample, double past) const;
  /// A frame made elsewhere.
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
  double last_reached_t_ = 0;  ///< of the last sample, as of CertifiedSample
  int taken_ = 0;
};

}  // namespace gridshell::simulate
