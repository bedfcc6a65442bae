#include <hdf5.h>

#include <array>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

#include "engine/record/journal.h"
#include "engine/record/summary.h"
#include "engine/record/trajectory_file.h"
#include "tests/engine/record/sample_run.h"
#include "tests/fuzz/targets.h"
#include "tests/temporary_folder.h"

namespace gridshell::fuzz {
namespace {

using namespace gridshell::record;

/// Takes numbers from the input until it ends, and zeros after that.
class Directions {
 public:
  explicit Directions(std::string_view bytes) : left_(bytes) {}
  bool any() const { return !left_.empty(); }
  std::uint8_t byte() {
    if (left_.empty()) return 0;
    const auto value = std::uint8_t(left_.front());
    left_.remove_prefix(1);
    return value;
  }
  template <class T>
  T number() {
    T value{};
    for (std::size_t k = 0; k < sizeof value; ++k)
      reinterpret_cast<std::uint8_t*>(&value)[k] = byte();
    return value;
  }

 private:
  std::string_view left_;
};

constexpr std::array names{"/nodes",
                           "/rods",
                           "/joints",
                           "/cells",
                           "/cell_K",
                           "/K_bins",
                           "/frames/frame",
                           "/frames/event",
                           "/frames/energy_bend_mJ",
                           "/layout/edge_points",
                           "/layout/original_boundary",
                           "/layout/net_nodes",
                           "/parts/names",
                           "/parts/seam_rods",
                           "/parts/0/rods",
                           "/layout",
                           "/parts"};

hid_t some_type(Directions& in) {
  const auto kind = std::size_t(in.byte() % 8);
  if (kind < 3)
    return H5Tcopy(std::array{H5T_NATIVE_DOUBLE, H5T_NATIVE_INT, H5T_NATIVE_FLOAT}[kind]);
  if (kind < 5) {
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, kind == 3 ? std::size_t(1 + in.byte()) : H5T_VARIABLE);
    return text;
  }
  if (kind < 7) return H5Tvlen_create(kind == 5 ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE);
  const hid_t compound = H5Tcreate(H5T_COMPOUND, 40);
  H5Tinsert(compound, "i", 0, H5T_NATIVE_INT);
  H5Tinsert(compound, in.byte() % 2 ? "j" : "k", 8, H5T_NATIVE_DOUBLE);
  return compound;
}

/// replaces a dataset by one of a random type and shape
void replace(hid_t file, const char* name, Directions& in) {
  H5Ldelete(file, name, H5P_DEFAULT);
  const hid_t type = some_type(in);
  std::vector<hsize_t> dims;
  for (int k = in.byte() % 4; k > 0; --k) dims.push_back(in.byte() % 40);
  if (!dims.empty() && in.byte() % 4 == 0) dims[0] = in.number<hsize_t>() >> (in.byte() % 64);
  const hid_t space = dims.empty() ? H5Screate(H5S_SCALAR)
                                   : H5Screate_simple(int(dims.size()), dims.data(), nullptr);
  const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  const auto kind = H5Tget_class(type);
  const bool plain = kind == H5T_INTEGER || kind == H5T_FLOAT;
  if (set >= 0 && plain && count > 0 && count < 100000) {
    std::vector<std::uint8_t> bytes(std::size_t(count) * H5Tget_size(type));
    for (auto& byte : bytes) byte = in.byte();
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
  }
  if (set >= 0) H5Dclose(set);
  H5Sclose(space);
  H5Tclose(type);
}

/// overwrites some bytes of a dataset of numbers
void overwrite(hid_t file, const char* name, Directions& in) {
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
  if (set < 0) return;
  const hid_t type = H5Dget_type(set), space = H5Dget_space(set);
  const auto kind = H5Tget_class(type);
  // an earlier change may have made the dataset huge; then no bytes are read
  const hssize_t there = H5Sget_simple_extent_npoints(space), count = there < 100000 ? there : 0;
  std::vector<std::uint8_t> bytes(count > 0 ? std::size_t(count) * H5Tget_size(type) : 0);
  const bool plain = kind == H5T_INTEGER || kind == H5T_FLOAT || kind == H5T_COMPOUND;
  if (plain && !bytes.empty() &&
      H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0) {
    for (int k = 1 + in.byte() % 8; k > 0; --k)
      bytes[in.number<std::uint16_t>() % bytes.size()] = in.byte();
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
  }
  H5Sclose(space), H5Tclose(type), H5Dclose(set);
}

void change(hid_t file, Directions& in) {
  const char* name = names[in.byte() % names.size()];
  const auto way = in.byte() % 4;
  if (way == 1) return replace(file, name, in);
  if (way == 2) return overwrite(file, name, in);
  H5Ldelete(file, name, H5P_DEFAULT);
  if (way == 3)
    H5Lcreate_soft(names[in.byte() % names.size()], file, name, H5P_DEFAULT, H5P_DEFAULT);
}

void look_at(const Trajectory& run) {
  for (const Frame& frame : run.frames)
    if (frame.nodes.size() > 0 && frame.nodes(0, 0) == 0.125) std::fputs("", stderr);
}

/// the bytes of the sample trajectory without its checksum
const std::string& sample_file() {
  static const std::string bytes = [] {
    const TemporaryFolder folder;
    (void)write_trajectory(folder / "a.h5", sample_trajectory());
    std::ostringstream text;
    text << std::ifstream(folder / "a.h5", std::ios::binary).rdbuf();
    return text.str().substr(512);
  }();
  return bytes;
}

}  // namespace

void summary(std::string_view bytes) {
  const InputFile file(bytes);
  const auto read = read_summary(file.path());
  if (read) (void)to_json(*read);
}

void journal(std::string_view bytes) {
  const InputFile file(bytes);
  if (const auto read = read_journal(file.path(), false)) look_at(read->trajectory);
}

void trajectory(std::string_view bytes) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const InputFile file(sample_file());
  Directions in(bytes);
  const hid_t open = H5Fopen(file.path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  if (open < 0) return;
  for (int k = 0; k < 6 && in.any(); ++k) change(open, in);
  H5Fclose(open);
  if (const auto read = read_trajectory(file.path(), {.no_checksum = true, .trial = false}))
    look_at(*read);
}

}  // namespace gridshell::fuzz
