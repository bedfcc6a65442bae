// Files that appear under their final name only when they are whole: written beside it, then
// renamed. A killed or failed run leaves what stood there before.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace gridshell {

/// A file in the making, for writers that need a path (HDF5, libpng, an encoder):
///
///     AtomicFile file("out/trajectory.h5");
///     ... write, flush and close file.temporary() ...
///     return file.commit();
///
/// Without a commit the temporary is removed. It lies in the folder of the final path, is hidden,
/// bears the process id (two runs do not meet) and keeps the extension.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path final_path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }

  /// Renames the temporary, which must be closed, to the final path. Errors: Fault::io with the
  /// final path and the system's reason.
  Result<void> commit();

 private:
  std::filesystem::path final_, temporary_;
  bool committed_ = false;
};

/// Writes all of `bytes` to an open file. 0, or the system's error number, ENOSPC for a full disk.
int write_all(int descriptor, std::string_view bytes);

/// Writes `bytes` to `path` as one AtomicFile; a full disk is noticed at write, flush or close.
/// Errors: Fault::io, "cannot write 'path': reason".
Result<void> write_file(const std::filesystem::path& path, std::string_view bytes);

/// What a text may come to at most, and what a picture or a table may.
inline constexpr std::uintmax_t largest_text = std::uintmax_t(16) << 20,
                                largest_file = std::uintmax_t(1) << 30;

/// The whole of a regular file of at most `limit` bytes: a pipe or a device, which may never end,
/// is refused. Errors: Fault::io, "cannot read 'path': reason".
Result<std::string> read_file(const std::filesystem::path& path,
                              std::uintmax_t limit = largest_file);

/// Makes a folder and its parents; one that exists is fine. Errors: Fault::io, path and reason.
Result<void> make_folder(const std::filesystem::path& folder);

}  // namespace gridshell
