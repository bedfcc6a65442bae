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

/// Where a segment begins and where to: what must be the same for a kept one to serve.
struct SegmentBegin {
  std::uint64_t state = 0;  ///< checksum of the nodes
  double from = 0, to = 0;  ///< path parameter
  std::vector<int> edges;   ///< between two joints, of its meshes

  bool operator==(const SegmentBegin&) const = default;
};

/// Lowest stiffness at a load step.
struct Softness {
  double t = 0, stiffness = 0;
};

/// A segment as far as it was followed.
struct KeptSegment {
  SegmentBegin begin;
  std::optional<Outcome> end;  ///< none: it was cut short
  NestedState state;           ///< state reached
  PathRecord record;
  std::vector<Event> events;
  Effort effort;
  std::vector<Softness> softening;
};

/// The files of a folder, `segment_0000` and on. What cannot be written is followed again. A file
/// that is damaged, or whose segment begins elsewhere, is as good as none.
class KeptSegments {
 public:
  /// What takes less than `worth_s` to follow is not worth a file; 0: everything is, at any cost.
  explicit KeptSegments(std::filesystem::path folder, double worth_s = 2);

  /// The next segment of the run, if something of it is kept.
  std::optional<KeptSegment> next(const SegmentBegin& begin);
  /// Whether so much was followed since the last file that it is worth another; a segment that has
  /// one is written at its end too, as those after it begin there.
  bool wants(bool at_its_end) const;
  /// Writes the segment that was begun last.
  void keep(const KeptSegment& segment);

 private:
  std::filesystem::path file() const;

  std::filesystem::path folder_;
  double worth_s_, wait_s_, written_at_;  // seconds_now()
  int segments_ = 0;
  bool has_file_ = false;  // the segment that was begun last
};

}  // namespace gridshell::simulate
