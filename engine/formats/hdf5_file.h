// A thin layer over the HDF5 C library: handles that close themselves, and what its writer and its
// reader share. Both stop at the first failure and remember why, so that a caller checks once at
// the end.
#pragma once

#include <hdf5.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/result.h"

namespace gridshell::record::hdf5 {

/// An HDF5 identifier, closed at the end of its life. Negative: the call that made it failed.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept { *this = std::move(other); }
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Keeps the library from printing errors while it lives.
class Quiet {
 public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// extents of a dataset, the slowest first
using Dims = std::vector<hsize_t>;
/// lists of unequal length
using Lists = std::vector<std::vector<int>>;

/// What writer and reader share: the open file and the first failure.
class File {
 public:
  bool good() const { return reason_.empty(); }
  /// why the first failure happened, in words; empty when all is well
  const std::string& reason() const { return reason_; }
  /// notes a failure at the object `at`, with the library's innermost reason
  void fail_at(const std::string& at);
  void fail_because(std::string reason);

 protected:
  /// notes a failure unless `result` is a success
  bool check(hid_t result, const std::string& at);
  /// closes the file now, for whoever must know that all was written
  void close() { file_ = Handle(); }

  Quiet quiet_;
  Handle file_;

 private:
  std::string reason_;
};

/// Variable-length UTF-8 text, and variable-length lists of int, in memory.
Handle string_type();
Handle list_type();
Handle space_of(const Dims& dims);
/// The part of a dataset that the k-th of its first dimension fills, and the same in memory.
std::pair<Handle, Handle> slice_spaces(hid_t dataset, hsize_t k);

// An HDF5 driver that writes to a descriptor and does not report a failed write to the library:
// version 1.10 loses track of its data on a full disk and may crash. The failure is stored for the
// caller.

/// Where the bytes go; outlives the file.
struct Stream {
  int descriptor = -1;     ///< open for reading and writing, the caller's
  std::size_t before = 0;  ///< bytes of the file before the HDF5 part
  int failure = 0;         ///< errno of the first write that failed
};

/// Access properties of a file that writes to `stream`.
Handle access_of(Stream& stream);

// Writes HDF5 files: small ones in memory, large ones straight to a descriptor.

/// Makes a file in memory, or on a stream. Every call after a failure does nothing.
class Writer : public File {
 public:
  /// Writes to memory; `name` distinguishes files that threads write at the same time.
  explicit Writer(const std::string& name);
  /// Writes to `stream`, which outlives it; whoever has closed the file asks the stream whether all
  /// of it arrived.
  explicit Writer(Stream& stream);
  void group(const std::string& name);
  void attribute(const std::string& object, const char* name, double value);
  void attribute(const std::string& object, const char* name, const std::string& value);
  /// `data` of `type` in memory; null only makes the dataset, to be filled by write_slice
  void dataset(const std::string& name, hid_t type, const Dims& dims, const void* data,
               const char* unit);
  /// the k-th of the first dimension
  void write_slice(const std::string& name, hid_t type, hsize_t k, const void* data);
  void strings(const std::string& name, const std::vector<std::string>& values);
  void lists(const std::string& name, const Lists& values);
  /// the whole file in memory; empty when anything failed, now or before
  std::string bytes();
  /// all of a stream is written after this
  void finish() { close(); }

 private:
  void open(const std::string& name, hid_t access);
  Handle no_times_, no_group_times_;
};

// Reads HDF5 files that may come from anybody: every object is checked before anything of it is
// read.

/// Reads the bytes of a file, or a file on the disk. Every call after a failure does nothing and
/// returns empty values. An object is read only if it has the requested type and rank, is stored in
/// the file itself (no external storage, no filters, only hard links) and is no larger than the
/// file. The library parses the structures of the format, and damaged ones can crash it: read
/// untrusted files in a subprocess first (read_in_subprocess()).
class Reader : public File {
 public:
  /// A copy of these bytes.
  explicit Reader(std::string_view bytes);
  explicit Reader(const std::filesystem::path& file);
  bool has(const std::string& name);
  /// extents of a dataset; a failure when it has another number of dimensions
  Dims dims(const std::string& name, std::size_t rank, hid_t type = H5T_NATIVE_DOUBLE);
  void read(const std::string& name, hid_t type, void* data);
  void read_slice(const std::string& name, hid_t type, hsize_t k, void* data);
  template <class T>
  std::vector<T> vector(const std::string& name, hid_t type) {
    const Dims extents = dims(name, 1, type);
    std::vector<T> values(good() ? extents[0] : 0);
    read(name, type, values.data());
    return values;
  }
  double attribute(const std::string& object, const char* name);
  /// `otherwise` where there is none, as in what an older version wrote.
  double attribute_or(const std::string& object, const char* name, double otherwise);
  std::string text_attribute(const std::string& object, const char* name);
  std::vector<std::string> strings(const std::string& name);
  Lists lists(const std::string& name);

 private:
  /// whether every part of a path exists and is a hard link
  bool linked(const std::string& name);
  /// the dataset, if it is one whose values can be read as `type` and lie in the file
  Handle dataset(const std::string& name, hid_t type);
  Handle attribute_of(const std::string& object, const char* name, H5T_class_t kind);
  /// whether the lists or texts of `set` are smaller than the file
  bool lists_fit(const std::string& name, hid_t set, hid_t type, hid_t space);
  /// take(item) for every list or text of a dataset
  template <class Pointer, class Take>
  void read_lists(const std::string& name, const Handle& type, const Take& take);

  std::uintmax_t file_bytes_ = 0;
};

}  // namespace gridshell::record::hdf5

// A reading tried out where it can do no harm.

namespace gridshell::record {

/// Runs `reading` in a subprocess with a quarter of the machine's memory (at least 1 GB) and 20 s
/// in addition to what the process has used: the HDF5 library may crash, loop or allocate all
/// memory on crafted structures. The value of `reading` is ignored; only its return counts. Errors:
/// bad_input if it did not return.
Result<void> read_in_subprocess(const std::function<void()>& reading);

}  // namespace gridshell::record
