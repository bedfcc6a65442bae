#include "engine/record/hdf5_file.h"

#include <fmt/format.h>
#include <hdf5_hl.h>

namespace gridshell::record::hdf5 {
namespace {

/// H5Ewalk2 callback: keeps the innermost description
herr_t keep_innermost(unsigned depth, const H5E_error2_t* error, void* out) {
  if (depth == 0 && error->desc) *static_cast<std::string*>(out) = error->desc;
  return 0;
}

std::string innermost_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &reason);
  return reason.empty() ? "unknown failure in the HDF5 library" : reason;
}

Handle string_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

Handle list_type() { return Handle(H5Tvlen_create(H5T_NATIVE_INT), H5Tclose); }

Handle space_of(const Dims& dims) {
  return Handle(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose);
}

/// the part of `file` that the k-th of its first dimension fills, and the same in memory
std::pair<Handle, Handle> slice_spaces(hid_t dataset, hsize_t k) {
  Handle file(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(file);
  if (rank < 1) return {};
  Dims count(rank), start(rank, 0);
  H5Sget_simple_extent_dims(file, count.data(), nullptr);
  count[0] = 1;
  start[0] = k;
  if (H5Sselect_hyperslab(file, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0)
    return {};
  return {std::move(file), space_of(count)};
}

}  // namespace

Quiet::Quiet() {
  H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Quiet::~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

void File::fail_because(std::string reason) {
  if (good()) reason_ = std::move(reason);
}

void File::fail_at(const std::string& at) {
  fail_because(fmt::format("{}: {}", at, innermost_reason()));
}

bool File::check(hid_t result, const std::string& at) {
  if (result < 0) fail_at(at);
  return result >= 0;
}

Writer::Writer(const std::string& name, std::size_t expected_bytes) {
  // times of making would make equal runs differ
  no_times_ = Handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(no_times_, false);
  no_group_times_ = Handle(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(no_group_times_, false);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, expected_bytes + 65536, false);
  // kept in memory: no file of this name is touched
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

Reader::Reader(std::string_view bytes) {
  // read where it lies: neither copied, written to nor released
  file_ = Handle(H5LTopen_file_image(const_cast<char*>(bytes.data()), bytes.size(),
                                     H5LT_FILE_IMAGE_DONT_COPY | H5LT_FILE_IMAGE_DONT_RELEASE),
                 H5Fclose);
  check(file_, "file");
}

bool Reader::has(const std::string& name) {
  return good() && H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
}

Dims Reader::dims(const std::string& name, std::size_t rank) {
  if (!good()) return {};
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!check(set, name)) return {};
  const Handle space(H5Dget_space(set), H5Sclose);
  const int found = H5Sget_simple_extent_ndims(space);
  if (found != static_cast<int>(rank)) {
    fail_because(fmt::format("{} has {} dimensions, expected {}", name, found, rank));
    return {};
  }
  Dims extents(rank);
  H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  return extents;
}

void Reader::read(const std::string& name, hid_t type, void* data) {
  if (!good()) return;
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (check(set, name)) check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), name);
}

void Reader::read_slice(const std::string& name, hid_t type, hsize_t k, void* data) {
  if (!good()) return;
  const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  const auto [in_file, in_memory] = slice_spaces(set, k);
  check(H5Dread(set, type, in_memory, in_file, H5P_DEFAULT, data), name);
}

double Reader::attribute(const std::string& object, const char* name) {
  double value = 0;
  if (good())
    check(H5LTget_attribute_double(file_, object.c_str(), name, &value), object + "." + name);
  return value;
}

std::string Reader::text_attribute(const std::string& object, const char* name) {
  hsize_t extent = 0;
  H5T_class_t kind{};
  std::size_t size = 0;
  if (!good() || H5LTget_attribute_info(file_, object.c_str(), name, &extent, &kind, &size) < 0 ||
      kind != H5T_STRING)
    return {};
  std::string text(size, '\0');
  check(H5LTget_attribute_string(file_, object.c_str(), name, text.data()), object + "." + name);
  return text.c_str();
}

std::vector<std::string> Reader::strings(const std::string& name) {
  const Handle type = string_type();
  std::vector<char*> pointers = vector<char*>(name, type);
  std::vector<std::string> values;
  if (!good()) return values;
  for (const char* text : pointers) values.emplace_back(text ? text : "");
  const Handle space = space_of({pointers.size()});
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
  return values;
}

Lists Reader::lists(const std::string& name) {
  const Handle type = list_type();
  std::vector<hvl_t> pointers = vector<hvl_t>(name, type);
  Lists values;
  if (!good()) return values;
  for (const hvl_t& list : pointers) {
    const int* first = static_cast<const int*>(list.p);
    values.emplace_back(first, first + list.len);
  }
  const Handle space = space_of({pointers.size()});
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
  return values;
}

}  // namespace gridshell::record::hdf5
