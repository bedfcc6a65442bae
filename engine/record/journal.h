// frames.journal: the frames of an unfinished run. Each frame is on the disk as soon as it is
// found.
//
// The file has a first line that names the format, then records: kind (4 bytes), length (8),
// payload, checksum (8) of all of these. The first record is the head (preset, names of the
// columns, layout); every other record is a frame, in the order in which frames were found. Of two
// frames with the same index the later one counts. The journal of a killed run can be read up to
// its last complete record. Numbers have the byte order of the machine.
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

/// Names of the journal in a run's folder, and of the journal of the coarser mesh before, which
/// remains until the finer mesh has as many frames.
inline constexpr const char *journal_name = "frames.journal",
                            *coarser_journal_name = "frames.coarser.journal";

/// The run that frames belong to.
struct RunIdentity {
  std::string preset;  ///< name of the preset
  Kind kind = Kind::unknown;
  std::string title = {};  ///< written to the run's files, not to a journal
};

/// Writes a journal. Every record is passed to the operating system at once.
class JournalWriter {
 public:
  /// Creates a journal, replacing an older one. Errors: io with path and reason.
  static Result<JournalWriter> create(const std::filesystem::path& path, const RunIdentity& name,
                                      const Layout& layout);

  /// Appends a frame. Errors: io with path and reason; a partial write is removed.
  Result<void> append(const Frame& frame);

  /// Number of frames with different indices.
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

/// Opens a journal. Frames after a damaged record are left out. `trial`: whether the layout is
/// first read in a process of its own, so that a damaged file cannot end this one. Errors: io if
/// the file cannot be read; bad_input if it is no journal or its head is damaged.
Result<Journal> read_journal(const std::filesystem::path& path, bool trial = true);

/// Opens the journal of a run's folder with the most frames. Errors: those of read_journal().
Result<Journal> read_journal_of(const std::filesystem::path& folder);

/// The name of the preset in a folder's journal; empty if there is no journal with a complete head.
std::optional<std::string> preset_of_journal(const std::filesystem::path& folder);

/// Number of frames in a journal; 0 if the file is no journal. The file may be damaged.
std::size_t frames_in_journal(const std::filesystem::path& file);
/// Number of frames in the longer of a folder's journals.
std::size_t frames_in_journals(const std::filesystem::path& folder);

// Records of a journal: the head, then frames, packed.

/// The head of a journal: the run, the names of the frames' columns, and the layout as bytes for
/// layout_of_image().
struct JournalHead {
  RunIdentity name;
  std::vector<std::string> columns;
  std::string layout;
};

/// The payload of the head.
std::string packed_head(const RunIdentity& name, const Layout& layout);
/// The head in a payload; empty if it is damaged.
std::optional<JournalHead> unpacked_head(std::string_view bytes);

/// The payload of a frame, which starts with its index.
std::string packed_frame(const Frame& frame);
/// The frame in a payload. `columns` are the names in the head; columns that this version does not
/// know are skipped. Errors: bad_input.
Result<Frame> unpacked_frame(std::string_view bytes, const std::vector<std::string>& columns);

}  // namespace gridshell::record
