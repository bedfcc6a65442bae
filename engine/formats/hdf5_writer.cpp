#include <fmt/format.h>
#include <hdf5_hl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>

#include "engine/formats/hdf5_file.h"

namespace gridshell::record::hdf5 {
namespace {

/// Callback of H5Ewalk2 that stores the innermost description.
herr_t keep_innermost(unsigned depth, const H5E_error2_t* error, void* out) {
  // no exception may pass through the library: a reason that does not fit into memory is left out
  try {
    if (depth == 0 && error->desc) *static_cast<std::string*>(out) = error->desc;
  } catch (const std::bad_alloc&) {
  }
  return 0;
}

std::string innermost_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &reason);
  return reason.empty() ? "unknown failure in the HDF5 library" : reason;
}

/// A file that the driver has opened.
struct Open {
  H5FD_t shared{};  // must be the first member: the library knows only this one
  Stream* stream = nullptr;
  haddr_t allocated = 0, written = 0;
};

Open& of(H5FD_t* file) { return *reinterpret_cast<Open*>(file); }
const Open& of(const H5FD_t* file) { return *reinterpret_cast<const Open*>(file); }

H5FD_t* open_file(const char*, unsigned, hid_t access, haddr_t) {
  const auto* info = static_cast<Stream* const*>(H5Pget_driver_info(access));
  if (!info) return nullptr;
  auto* file = new (std::nothrow) Open;
  if (!file) return nullptr;
  file->stream = *info;
  return &file->shared;
}

herr_t close_file(H5FD_t* file) {
  delete &of(file);
  return 0;
}

int compare(const H5FD_t* a, const H5FD_t* b) { return a < b ? -1 : a > b; }

herr_t query(const H5FD_t*, unsigned long* flags) {
  if (flags)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t end_allocated(const H5FD_t* file, H5FD_mem_t) { return of(file).allocated; }
herr_t allocate(H5FD_t* file, H5FD_mem_t, haddr_t end) {
  of(file).allocated = end;
  return 0;
}
haddr_t end_written(const H5FD_t* file, H5FD_mem_t) { return of(file).written; }

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* data) {
  const Stream& stream = *of(file).stream;
  auto* to = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = ::pread(stream.descriptor, to, size, off_t(stream.before + at));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    to += got, at += haddr_t(got), size -= std::size_t(got);
  }
  // bytes past the end of the file are zero
  std::memset(to, 0, size);
  return 0;
}

herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, const void* data) {
  Stream& stream = *of(file).stream;
  of(file).written = std::max(of(file).written, at + size);
  const auto* from = static_cast<const char*>(data);
  while (size > 0 && !stream.failure) {
    const ssize_t put = ::pwrite(stream.descriptor, from, size, off_t(stream.before + at));
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) {
      stream.failure = put < 0 ? errno : ENOSPC;
      break;
    }
    from += put, at += haddr_t(put), size -= std::size_t(put);
  }
  return 0;
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
  Open& open = of(file);
  Stream& stream = *open.stream;
  open.written = open.allocated;
  if (!stream.failure && ::ftruncate(stream.descriptor, off_t(stream.before + open.allocated)) != 0)
    stream.failure = errno;
  return 0;
}

hid_t driver() {
  static const hid_t registered = [] {
    H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION
    driver.version = H5FD_CLASS_VERSION;
    driver.value = 512;  // the first number that is not reserved
#endif
    driver.name = "gridshell_stream";
    driver.maxaddr = haddr_t(1) << 62;
    driver.fc_degree = H5F_CLOSE_WEAK;
    driver.fapl_size = sizeof(Stream*);
    driver.open = open_file;
    driver.close = close_file;
    driver.cmp = compare;
    driver.query = query;
    driver.get_eoa = end_allocated;
    driver.set_eoa = allocate;
    driver.get_eof = end_written;
    driver.read = read;
    driver.write = write;
    driver.truncate = truncate;
    // all kinds of bytes share one space
    std::fill(std::begin(driver.fl_map), std::end(driver.fl_map), H5FD_MEM_DEFAULT);
    return H5FDregister(&driver);
  }();
  return registered;
}

}  // namespace

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

Handle access_of(Stream& stream) {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  Stream* const info = &stream;
  // after an error no access at all: with its default driver the library would create a file
  return H5Pset_driver(access, driver(), &info) < 0 ? Handle() : std::move(access);
}

Writer::Writer(const std::string& name) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, 65536, false);
  open(name, access);
}

Writer::Writer(Stream& stream) { open("stream", access_of(stream)); }

void Writer::open(const std::string& name, hid_t access) {
  // no times of creation: equal runs give equal bytes
  no_times_ = Handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(no_times_, false);
  no_group_times_ = Handle(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(no_group_times_, false);
  // neither driver creates a file of this name on the disk
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
