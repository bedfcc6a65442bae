// Writes HDF5 files: small ones in memory, large ones straight to a descriptor.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/record/hdf5_file.h"
#include "engine/record/hdf5_stream.h"

namespace gridshell::record::hdf5 {

/// Makes a file in memory, or on a stream. Every call after a failure does nothing.
class Writer : public File {
 public:
  /// In memory; `name` tells apart the files that threads make at a time.
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

}  // namespace gridshell::record::hdf5
