// A run's folder as it fills: every frame is on the disk as soon as it is found.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/record/journal.h"
#include "engine/record/sink.h"
#include "engine/record/summary.h"

namespace gridshell::record {

/// Writes frames to the journal of `folder`, of which none stays in memory. When a finer mesh
/// begins, the coarser journal is kept beside the new one until that holds as many frames.
class FolderSink final : public Sink {
 public:
  FolderSink(std::filesystem::path folder, RunName name)
      : folder_(std::move(folder)), name_(std::move(name)) {}

  Result<void> begin(Layout layout) override;
  Result<void> take(Frame frame) override;

  /// Makes the journal a run's files (run_folder.h) and removes it. The trajectory reads its frames
  /// from the disk as they are asked for. Errors: io, bad_input.
  Result<Trajectory> finish(const Summary& summary);

 private:
  Result<void> keep_coarser();

  std::filesystem::path folder_;
  RunName name_;
  std::optional<JournalWriter> journal_;
  std::size_t coarser_frames_ = 0;
};

/// Removes the journals of a folder whose run is written.
void remove_journals(const std::filesystem::path& folder);

}  // namespace gridshell::record
