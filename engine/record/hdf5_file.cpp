#include "engine/record/hdf5_file.h"

#include <fmt/format.h>

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

}  // namespace gridshell::record::hdf5
