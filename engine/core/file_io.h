// Files that appear under their final name only when they are complete: written to a temporary file
// in the same folder, then renamed. After a killed or failed run the old file is unchanged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/result.h"

namespace gridshell {

/// A file while it is written, for writers that need a path (HDF5, libpng, an encoder):
///
///     AtomicFile file("out/trajectory.h5");
///     ... write, flush and close file.temporary() ...
///     return file.commit();
///
/// Without a commit the temporary file is removed. It is in the folder of the final path, is
/// hidden, has the process id in its name (for several runs at once) and the same extension.
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

/// A file descriptor that is closed by its destructor; negative: none.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  operator int() const { return number_; }
  /// Closes the file. Returns 0 or the system's error number: data still in the cache may fail to
  /// be written now.
  int close();

 private:
  int number_;
};

/// An error Fault::io, "cannot WHAT 'path': reason of the system".
tl::unexpected<Error> fail_io(const char* what, const std::filesystem::path& path, int code);

/// A regular file open for reading: a pipe or a device, which may never end, is refused.
class ReadableFile {
 public:
  /// Errors: Fault::io, "cannot read 'path': reason".
  static Result<ReadableFile> open(const std::filesystem::path& path);
  std::uint64_t size() const { return size_; }
  /// Reads exactly `size` bytes from `at`; empty if there are fewer.
  std::optional<std::string> read(std::uint64_t at, std::uint64_t size) const;

 private:
  friend Result<std::string> read_file(const std::filesystem::path&, std::uintmax_t);
  Descriptor file_;
  std::uint64_t size_ = 0;
};

/// Writes all of `bytes` to an open file. Returns 0, or the system's error number, ENOSPC for a
/// full disk.
int write_all(int descriptor, std::string_view bytes);

/// Appends `bytes` to an open file of `size` bytes, or removes a partial write. Returns as
/// write_all().
int append_whole(int descriptor, std::string_view bytes, std::uint64_t& size);

/// Writes `bytes` to `path` as one AtomicFile; a full disk is noticed at write, flush or close.
/// Errors: Fault::io, "cannot write 'path': reason".
Result<void> write_file(const std::filesystem::path& path, std::string_view bytes);

/// Largest sizes of a text file, and of a picture or table, in bytes.
inline constexpr std::uintmax_t largest_text = std::uintmax_t(16) << 20,
                                largest_file = std::uintmax_t(1) << 30;

/// Reads a complete regular file of at most `limit` bytes. Errors: Fault::io, "cannot read 'path':
/// reason".
Result<std::string> read_file(const std::filesystem::path& path,
                              std::uintmax_t limit = largest_file);

/// Reads a pipe to its end, at most `limit` bytes; waits for the bytes. Errors as read_file().
Result<std::string> read_pipe(const std::filesystem::path& path, std::uintmax_t limit);

/// Makes a folder and its parents; an existing folder is no error. Errors: Fault::io, path and
/// reason.
Result<void> make_folder(const std::filesystem::path& folder);

/// Large files have a CRC-32; lines, and files of version 0.2, a 64-bit FNV-1a.
enum class ChecksumKind { fnv1a, crc32 };

/// The checksum of a run's files. It detects damage, not intent.
class Checksum {
 public:
  explicit Checksum(ChecksumKind kind = ChecksumKind::fnv1a)
      : kind_(kind), sum_(kind == ChecksumKind::fnv1a ? 14695981039346656037u : 0) {}
  void add(std::string_view bytes);
  std::uint64_t value() const { return sum_; }
  static std::uint64_t of(std::string_view bytes, ChecksumKind kind = ChecksumKind::fnv1a) {
    Checksum sum(kind);
    sum.add(bytes);
    return sum.value();
  }

 private:
  ChecksumKind kind_;
  std::uint64_t sum_;
};

}  // namespace gridshell
