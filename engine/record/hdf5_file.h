// A thin layer over the HDF5 C library: handles that close themselves, and what its writer and its
// reader share. Both stop at the first failure and remember why, so that a caller checks once at
// the end.
#pragma once

#include <hdf5.h>

#include <Eigen/Core>
#include <string>
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

}  // namespace gridshell::record::hdf5
