// Reads HDF5 files that may come from anybody: every object is checked before anything of it is
// read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/record/hdf5_file.h"

namespace gridshell::record::hdf5 {

/// Reads the bytes of a file, or a file where it lies. Every call after a failure does nothing and
/// returns empty values. An object is read only where it is what was asked for: its type and rank,
/// stored in the file itself (no external storage, no filters, no links but hard ones), and no
/// larger than the file that holds it. The structures of the format itself are the library's to
/// parse, and damaged ones can crash it: read in a process of its own first (trial.h).
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
  std::string text_attribute(const std::string& object, const char* name);
  std::vector<std::string> strings(const std::string& name);
  Lists lists(const std::string& name);

 private:
  /// whether every part of a path exists and is a hard link
  bool linked(const std::string& name);
  /// the dataset, if it is one whose values can be read as `type` and lie in the file
  Handle dataset(const std::string& name, hid_t type);
  Handle attribute_of(const std::string& object, const char* name, H5T_class_t kind);
  /// whether the lists or texts of `set` come to less than the file
  bool lists_fit(const std::string& name, hid_t set, hid_t type, hid_t space);
  /// take(item) for every list or text of a dataset
  template <class Pointer, class Take>
  void read_lists(const std::string& name, const Handle& type, const Take& take);

  std::uintmax_t file_bytes_ = 0;
};

}  // namespace gridshell::record::hdf5
