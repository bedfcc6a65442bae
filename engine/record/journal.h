// frames.journal: the frames of a run that is not finished, each on the disk as soon as it is
// found.
//
// A line that names the file, then records: kind (4 bytes), length (8), payload, checksum (8) of
// all of these. The first record is the head (preset, names of the columns, layout), every other
// one per frame, in the order in which they were found; of two with one index the later counts. A
// run that is killed leaves a journal that reads up to its last whole record. Numbers are those of
// the machine.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/file_io.h"
#include "engine/core/result.h"
#include "engine/record/frame.h"
#include "engine/record/summary.h"
#include "engine/record/trajectory.h"

namespace gridshell::record {

/// The journal of a run's folder; and of the coarser meshes before, while the finer ones have found
/// fewer frames.
inline constexpr const char *journal_name = "frames.journal",
                            *coarser_journal_name = "frames.coarser.journal";

/// Whose frames they are.
struct RunIdentity {
  std::string preset;
  Kind kind = Kind::unknown;
  std::string title = {};  ///< goes to the run's files; a journal does not keep it
};

/// A journal as it grows. Every record goes to the system at once.
class JournalWriter {
 public:
  /// Creates a journal, replacing an older one. Errors: io with path and reason.
  static Result<JournalWriter> create(const std::filesystem::path& path, const RunIdentity& name,
                                      const Layout& layout);

  /// Appends a frame. Errors: io with path and reason; a partial write is removed.
  Result<void> append(const Frame& frame);

  /// number of different frames in it
  std::size_t frames() const { return indices_.size(); }

 private:
  Result<void> put(std::uint32_t kind, const std::string& payload);

  std::filesystem::path path_;
  Descriptor file_;
  std::uint64_t size_ = 0;
  std::set<int> indices_;
};

/// Contents of a journal: frames in order of their index, read one at a time.
struct Journal {
  RunIdentity name;
  Trajectory trajectory;
};

/// Opens a journal. Errors: io when it cannot be read; bad_input when it is none, or its head is
/// damaged. What follows a damaged record is left out.
Result<Journal> read_journal(const std::filesystem::path& path, bool trial = true);

/// The journal of a run's folder with the most frames. Errors: as above.
Result<Journal> read_journal_of(const std::filesystem::path& folder);

/// The name of the preset in a folder's journal; empty without a journal with a complete head.
std::optional<std::string> preset_of_journal(const std::filesystem::path& folder);

/// Number of frames in a journal; 0 if it is none. Nothing in the file is trusted.
std::size_t frames_in_journal(const std::filesystem::path& file);
/// Number of frames in the longer of a folder's journals.
std::size_t frames_in_journals(const std::filesystem::path& folder);

// Records of a journal: the head, then frames, packed.

/// Whose frames they are, the names of their columns, and the layout as layout_of_image() reads it.
struct JournalHead {
  RunIdentity name;
  std::vector<std::string> columns;
  std::string layout;
};

std::string packed_head(const RunIdentity& name, const Layout& layout);
/// Nothing where it is damaged.
std::optional<JournalHead> unpacked_head(std::string_view bytes);

/// The index comes first.
std::string packed_frame(const Frame& frame);
/// A frame whose columns are named so; those without a name here are left out. Errors: bad_input.
Result<Frame> unpacked_frame(std::string_view bytes, const std::vector<std::string>& columns);

}  // namespace gridshell::record
