// A thin layer over the HDF5 C library for trajectory_file.cpp: handles that close themselves, and
// a writer and a reader that stop at the first failure and remember why, so that a caller checks
// once at the end.
#pragma once

#include <hdf5.h>

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

  Quiet quiet_;
  Handle file_;

 private:
  std::string reason_;
};

/// Makes a file in memory: on a full disk the library (1.10) loses track of what it holds and may
/// crash, so its bytes go to the disk by write_atomically. Every call after a failure does nothing.
class Writer : public File {
 public:
  /// `name` tells apart the files that threads make at a time; `expected_bytes` are reserved at
  /// once
  Writer(const std::string& name, std::size_t expected_bytes);
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
  /// the whole file; empty when anything failed, now or before
  std::string bytes();

 private:
  Handle no_times_, no_group_times_;
};

/// Reads the bytes of a file, which must outlive it. Every call after a failure does nothing and
/// returns empty values. Damaged bytes can crash the library: check them before.
class Reader : public File {
 public:
  explicit Reader(std::string_view bytes);
  bool has(const std::string& name);
  /// extents of a dataset; a failure when it has another number of dimensions
  Dims dims(const std::string& name, std::size_t rank);
  void read(const std::string& name, hid_t type, void* data);
  void read_slice(const std::string& name, hid_t type, hsize_t k, void* data);
  template <class T>
  std::vector<T> vector(const std::string& name, hid_t type) {
    const Dims extents = dims(name, 1);
    std::vector<T> values(good() ? extents[0] : 0);
    read(name, type, values.data());
    return values;
  }
  double attribute(const std::string& object, const char* name);
  std::string text_attribute(const std::string& object, const char* name);
  std::vector<std::string> strings(const std::string& name);
  Lists lists(const std::string& name);
};

}  // namespace gridshell::record::hdf5
