// A thin layer over the HDF5 C library: handles that close themselves, a writer and a reader.
// Writer and reader do nothing after the first failure and store its reason, so that a caller
// checks once at the end.
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

/// An HDF5 identifier, which the destructor closes. Negative: the call that created it failed.
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

/// Prevents the library from printing errors during its lifetime.
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

/// Extents of a dataset, the slowest first.
using Dims = std::vector<hsize_t>;
/// Lists of different lengths.
using Lists = std::vector<std::vector<int>>;

/// Base of writer and reader: the open file and the first failure.
class File {
 public:
  bool good() const { return reason_.empty(); }
  /// Reason of the first failure; empty: there was none.
  const std::string& reason() const { return reason_; }
  /// Stores a failure at the object `at`, with the library's innermost reason.
  void fail_at(const std::string& at);
  /// Stores a failure with this reason.
  void fail_because(std::string reason);

 protected:
  /// Stores a failure if `result` is negative. Returns whether it is not.
  bool check(hid_t result, const std::string& at);
  /// Closes the file, so that all data are written.
  void close() { file_ = Handle(); }

  Quiet quiet_;
  Handle file_;

 private:
  std::string reason_;
};

/// Type of variable-length UTF-8 text in memory.
Handle string_type();
/// Type of variable-length lists of int in memory.
Handle list_type();
Handle space_of(const Dims& dims);
/// The spaces of slice k of a dataset's first dimension, in the file and in memory.
std::pair<Handle, Handle> slice_spaces(hid_t dataset, hsize_t k);

// An HDF5 driver that writes to a descriptor and does not report a failed write to the library:
// version 1.10 loses track of its data on a full disk and may crash. The failure is stored for the
// caller.

/// Destination of the bytes; must outlive the file.
struct Stream {
  int descriptor = -1;     ///< open for reading and writing; the caller closes it
  std::size_t before = 0;  ///< number of bytes before the HDF5 part
  int failure = 0;         ///< errno of the first write that failed; 0: none
};

/// Access properties of a file that writes to `stream`.
Handle access_of(Stream& stream);

/// Writes an HDF5 file: a small one in memory, a large one to a stream. Every call after a failure
/// does nothing.
class Writer : public File {
 public:
  /// Writes to memory; `name` distinguishes files that threads write at the same time.
  explicit Writer(const std::string& name);
  /// Writes to `stream`, which must outlive it. After finish(), Stream::failure reports whether
  /// everything was written.
  explicit Writer(Stream& stream);
  void group(const std::string& name);
  void attribute(const std::string& object, const char* name, double value);
  void attribute(const std::string& object, const char* name, const std::string& value);
  /// Writes a dataset; `data` has `type` in memory; null: only creates it, for write_slice().
  void dataset(const std::string& name, hid_t type, const Dims& dims, const void* data,
               const char* unit);
  /// Writes slice k of the first dimension.
  void write_slice(const std::string& name, hid_t type, hsize_t k, const void* data);
  void strings(const std::string& name, const std::vector<std::string>& values);
  void lists(const std::string& name, const Lists& values);
  /// The complete file in memory; empty if there was a failure.
  std::string bytes();
  /// Closes the file, so that everything is written to the stream.
  void finish() { close(); }

 private:
  void open(const std::string& name, hid_t access);
  Handle no_times_, no_group_times_;
};

/// Reads an HDF5 file, which may be untrusted, from memory or from the disk. Every call after a
/// failure does nothing and returns empty values. An object is read only if it has the requested
/// type and rank, is stored in the file itself (no external storage, no filters, only hard links)
/// and is not larger than the file. Damaged structures of the format can crash the library: read
/// untrusted files in a subprocess first (read_in_subprocess()).
class Reader : public File {
 public:
  /// Reads a copy of these bytes.
  explicit Reader(std::string_view bytes);
  explicit Reader(const std::filesystem::path& file);
  /// Whether an object of this name exists.
  bool has(const std::string& name);
  /// Extents of a dataset; a failure if it has another number of dimensions.
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
  /// An attribute, or `otherwise` if there is none, as in files of older versions.
  double attribute_or(const std::string& object, const char* name, double otherwise);
  std::string text_attribute(const std::string& object, const char* name);
  std::vector<std::string> strings(const std::string& name);
  Lists lists(const std::string& name);

 private:
  /// Whether every part of a path exists and is a hard link.
  bool linked(const std::string& name);
  /// Opens a dataset whose values can be read as `type` and are in the file; else a failure.
  Handle dataset(const std::string& name, hid_t type);
  Handle attribute_of(const std::string& object, const char* name, H5T_class_t kind);
  /// Whether the lists or texts of `set` are smaller than the file.
  bool lists_fit(const std::string& name, hid_t set, hid_t type, hid_t space);
  /// Calls take(item) for every list or text of a dataset.
  template <class Pointer, class Take>
  void read_lists(const std::string& name, const Handle& type, const Take& take);

  std::uintmax_t file_bytes_ = 0;
};

}  // namespace gridshell::record::hdf5

namespace gridshell::record {

/// Runs `reading` as a trial in a subprocess, since the HDF5 library may crash, loop or allocate
/// all memory on damaged or crafted structures. The subprocess may use 20 s and, in addition to the
/// memory of this process, a quarter of the machine's memory (at least 1 GB). Errors: bad_input if
/// `reading` did not return.
Result<void> read_in_subprocess(const std::function<void()>& reading);

}  // namespace gridshell::record
