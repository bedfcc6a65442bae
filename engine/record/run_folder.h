// A run's folder: summary.json, joints.csv, cells.csv, frames.csv, bins.csv, trajectory.h5 and, for
// building blocks, seams.csv.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/record/journal.h"
#include "engine/record/summary.h"
#include "engine/record/trajectory.h"

namespace gridshell::record {

/// The text of joints.csv: position of every joint in the last frame, and its distance from its
/// position on the net, if there is one. In all CSV files numbers have the fewest digits that read
/// back bit for bit, and unknown ones are empty.
std::string joints_csv(const Trajectory& trajectory);

/// The text of cells.csv: K of every complete cell in the last frame, at its middle (u, v) of the
/// footprint and the centroid of its four joints.
std::string cells_csv(const Trajectory& trajectory);

/// The text of frames.csv: one line per frame.
std::string frames_csv(const Trajectory& trajectory);
/// The text of bins.csv: K of the cells in bins of x/L, one line per frame and bin.
std::string bins_csv(const Trajectory& trajectory);
/// The text of seams.csv: one line per rod across a seam of two building blocks, with gap and kink.
std::string seams_csv(const Layout& layout);

/// Writes these files into `folder`, which is created if missing; seams.csv only if there are
/// seams. Each file is complete or absent, and summary.json, written last, confirms the others.
/// Errors: Fault::io with path and reason; Fault::bad_input if the trajectory's parts are
/// inconsistent.
Result<void> write_run(const std::filesystem::path& folder, const Trajectory& trajectory,
                       const Summary& summary);

/// Writes frames to the journal of `folder` as soon as they are found; none stays in memory. When a
/// finer mesh starts, the coarser journal is retained until the new one has as many frames; so is
/// the journal of an interrupted run.
class FolderSink final : public Sink {
 public:
  FolderSink(std::filesystem::path folder, RunIdentity name)
      : folder_(std::move(folder)), name_(std::move(name)) {}

  Result<void> begin(Layout layout) override;
  Result<void> take(Frame frame) override;

  /// Converts the journal into a run's files (write_run()) and removes it. The trajectory reads its
  /// frames from the disk on demand. Errors: io, bad_input.
  Result<Trajectory> finish(const Summary& summary);

 private:
  Result<void> keep_coarser();

  std::filesystem::path folder_;
  RunIdentity name_;
  std::optional<JournalWriter> journal_;
  std::size_t coarser_frames_ = 0;
};

}  // namespace gridshell::record
