#include "engine/record/hdf5_writer.h"

#include <fmt/format.h>
#include <hdf5_hl.h>

namespace gridshell::record::hdf5 {

Writer::Writer(const std::string& name) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, 65536, false);
  open(name, access);
}

Writer::Writer(Stream& stream) { open("stream", access_of(stream)); }

void Writer::open(const std::string& name, hid_t access) {
  // times of making would make equal runs differ
  no_times_ = Handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(no_times_, false);
  no_group_times_ = Handle(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(no_group_times_, false);
  // no driver of ours touches a file of this name
  file_ = Handle(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  check(file_, "file");
}

void Writer::group(const std::string& name) {
  if (!good()) return;
  const Handle made(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, no_group_times_, H5P_DEFAULT),
                    H5Gclose);
  check(made, name);
}

void Writer::attribute(const std::string& object, const char* name, double value) {
  if (good()) check(H5LTset_attribute_double(file_, object.c_str(), name, &value, 1), object);
}

void Writer::attribute(const std::string& object, const char* name, const std::string& value) {
  if (good()) check(H5LTset_attribute_string(file_, object.c_str(), name, value.c_str()), object);
}

void Writer::dataset(const std::string& name, hid_t type, const Dims& dims, const void* data,
                     const char* unit) {
  if (!good()) return;
  // without the holes that a struct has in memory
  const Handle packed(H5Tcopy(type), H5Tclose);
  if (H5Tget_class(packed) == H5T_COMPOUND) H5Tpack(packed);
  const Handle space = space_of(dims);
  const Handle made(
      H5Dcreate2(file_, name.c_str(), packed, space, H5P_DEFAULT, no_times_, H5P_DEFAULT),
      H5Dclose);
  if (!check(made, name)) return;
  if (data && !check(H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), name)) return;
  if (*unit) attribute(name, "unit", std::string(unit));
}

void Writer::write_slice(const std::string& name, hid_t type, hsize_t k, const void* data) {
  if (!good()) return;
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  const auto [in_file, in_memory] = slice_spaces(set, k);
  check(H5Dwrite(set, type, in_memory, in_file, H5P_DEFAULT, data), name);
}

void Writer::strings(const std::string& name, const std::vector<std::string>& values) {
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  dataset(name, string_type(), {pointers.size()}, pointers.data(), "");
}

void Writer::lists(const std::string& name, const Lists& values) {
  std::vector<hvl_t> pointers;
  for (const std::vector<int>& list : values)
    pointers.push_back({list.size(), const_cast<int*>(list.data())});
  dataset(name, list_type(), {pointers.size()}, pointers.data(), "1");
}

std::string Writer::bytes() {
  if (!good() || !check(H5Fflush(file_, H5F_SCOPE_LOCAL), "file")) return {};
  const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
  if (!check(size, "file")) return {};
  std::string image(size, '\0');
  return check(H5Fget_file_image(file_, image.data(), image.size()), "file") ? image : "";
}

}  // namespace gridshell::record::hdf5
