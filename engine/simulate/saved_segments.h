// The followed segments of a run's path, each saved in a file, so that an interrupted run continues
// from its last certified state. A run follows the same segments in the same order whether or not
// it is observed; everything between them (first states, samples, confirmations) is computed again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/simulate/simulation.h"

namespace gridshell::simulate {

/// Start and requested end of a segment: a saved segment is used only if they are equal.
struct SegmentBegin {
  std::uint64_t state = 0;  ///< checksum of the nodes
  double from = 0, to = 0;  ///< path parameter
  std::vector<int> edges;   ///< edges per segment of its meshes

  bool operator==(const SegmentBegin&) const = default;
};

/// Lowest stiffness at a load step.
struct LowestStiffness {
  double t = 0, stiffness = 0;
};

/// A segment as far as it was followed.
struct SavedSegment {
  SegmentBegin begin;
  std::optional<Outcome> end;  ///< empty: it was interrupted
  NestedState state;           ///< state reached
  PathRecord record;
  std::vector<Event> events;
  Effort effort;
  std::vector<LowestStiffness> lowest_stiffness;
  /// Path parameter since which no coarser mesh has a state; empty: one has.
  std::optional<double> unmeasured_since;
  /// Last state of the next coarser mesh on this branch; time: its path parameter.
  std::optional<TimedState> companion;
};

/// The files of a folder, `segment_0001` and following. A segment is followed again if its file
/// could not be written, is damaged, or has another start or end.
class SavedSegments {
 public:
  /// Between two files at least `worth_s` pass, and 20 times the time that writing takes; 0: every
  /// load step is saved.
  explicit SavedSegments(std::filesystem::path folder, double worth_s = 2);

  /// The next segment of the run, if a part of it was saved.
  std::optional<SavedSegment> next(const SegmentBegin& begin);
  /// Whether enough was followed since the last file to write another; a saved segment is written
  /// at its end too, since later ones start there.
  bool should_save(bool at_its_end) const;
  /// Saves the segment that was started last.
  void save(const SavedSegment& segment);

 private:
  std::filesystem::path file() const;

  std::filesystem::path folder_;
  double worth_s_, wait_s_, written_at_;  // seconds_now()
  int segments_ = 0;
  bool has_file_ = false;  // whether the segment that was started last has a file
};

}  // namespace gridshell::simulate
