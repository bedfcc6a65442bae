#include "engine/record/hdf5_stream.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace gridshell::record::hdf5 {
namespace {

struct Open {
  H5FD_t shared{};  // first: the library sees only this
  Stream* stream = nullptr;
  haddr_t allocated = 0, written = 0;
};

Open& of(H5FD_t* file) { return *reinterpret_cast<Open*>(file); }
const Open& of(const H5FD_t* file) { return *reinterpret_cast<const Open*>(file); }

H5FD_t* open_file(const char*, unsigned, hid_t access, haddr_t) {
  const auto* info = static_cast<Stream* const*>(H5Pget_driver_info(access));
  if (!info) return nullptr;
  auto* file = new Open;
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
  // beyond the end there is nothing yet
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

Handle access_of(Stream& stream) {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  Stream* const info = &stream;
  H5Pset_driver(access, driver(), &info);
  return access;
}

}  // namespace gridshell::record::hdf5
