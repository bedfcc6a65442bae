#include "engine/record/trajectory_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <string_view>
#include <utility>

#include "engine/core/atomic_file.h"
#include "engine/record/consistency.h"
#include "engine/record/frame_columns.h"
#include "engine/record/hdf5_file.h"

namespace gridshell::record {
namespace {

using hdf5::Dims;
using hdf5::Handle;

const std::string format_name = "gridshell trajectory 1";

// HDF5 looks for its own beginning at 0, 512, 1024 ...: what lies before is the program's to use
constexpr std::size_t seal_size = 512;

/// Name and checksum (64-bit FNV-1a) of the HDF5 bytes that follow.
std::string seal_of(std::string_view hdf5) {
  std::uint64_t sum = 14695981039346656037u;
  for (const char byte : hdf5) sum = (sum ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  std::string seal = fmt::format("{}\n{} bytes, FNV-1a {:016x}\n", format_name, hdf5.size(), sum);
  seal.resize(seal_size, '\0');
  return seal;
}

/// The HDF5 bytes of a file, or why they are not to be trusted. Without a seal (another program
/// rewrote the file) they are taken as they are.
Result<std::string_view> unsealed(std::string_view bytes) {
  if (bytes.starts_with("\x89HDF\r\n\x1a\n")) return bytes;
  if (!bytes.starts_with(format_name)) return fail(Fault::bad_input, "it is not an HDF5 file");
  if (bytes.size() < seal_size) return fail(Fault::bad_input, "it is cut short");
  const std::string_view hdf5 = bytes.substr(seal_size);
  if (bytes.substr(0, seal_size) == seal_of(hdf5)) return hdf5;
  return fail(Fault::bad_input,
              "it is cut short, damaged or was changed: its checksum does not match");
}

Handle joint_type() {
  Handle type(H5Tcreate(H5T_COMPOUND, sizeof(Joint)), H5Tclose);
  H5Tinsert(type, "i", HOFFSET(Joint, i), H5T_NATIVE_INT);
  H5Tinsert(type, "j", HOFFSET(Joint, j), H5T_NATIVE_INT);
  H5Tinsert(type, "u_mm", HOFFSET(Joint, u_mm), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "v_mm", HOFFSET(Joint, v_mm), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "node", HOFFSET(Joint, node), H5T_NATIVE_INT);
  return type;
}

Handle cell_type() {
  const hsize_t four = 4;
  const Handle joints(H5Tarray_create2(H5T_NATIVE_INT, 1, &four), H5Tclose);
  Handle type(H5Tcreate(H5T_COMPOUND, sizeof(Cell)), H5Tclose);
  H5Tinsert(type, "i", HOFFSET(Cell, i), H5T_NATIVE_INT);
  H5Tinsert(type, "j", HOFFSET(Cell, j), H5T_NATIVE_INT);
  H5Tinsert(type, "u_mm", HOFFSET(Cell, u_mm), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "v_mm", HOFFSET(Cell, v_mm), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "joints", HOFFSET(Cell, joints), joints);
  return type;
}

hid_t memory_type(int) { return H5T_NATIVE_INT; }
hid_t memory_type(double) { return H5T_NATIVE_DOUBLE; }

void write_parts(hdf5::Writer& file, const Layout& layout) {
  std::vector<std::string> names, seams, families;
  std::vector<std::array<double, 3>> numbers;
  file.group("/parts");
  for (const Part& part : layout.parts) {
    const std::string group = fmt::format("/parts/{}", names.size());
    names.push_back(part.name);
    file.group(group);
    file.lists(group + "/rods", part.rods);
    for (const auto& [name, points] : {std::pair("/net", &part.net), {"/flat", &part.flat}})
      file.dataset(group + name, H5T_NATIVE_DOUBLE, {static_cast<hsize_t>(points->cols()), 3},
                   points->data(), "mm");
  }
  for (const SeamRod& rod : layout.seam_rods) {
    seams.push_back(rod.seam);
    families.emplace_back(1, rod.family);
    numbers.push_back({rod.line_mm, rod.gap_mm, rod.kink_deg});
  }
  file.strings("/parts/names", names);
  file.strings("/parts/seams", seams);
  file.strings("/parts/families", families);
  file.dataset("/parts/seam_rods", H5T_NATIVE_DOUBLE, {numbers.size(), 3}, numbers.data(),
               "mm, mm, degrees");
}

void write_loads(hdf5::Writer& file, const Layout& layout) {
  std::vector<int> joints;
  Eigen::Matrix3Xd directions(3, layout.loaded_joints.size());
  for (const LoadedJoint& load : layout.loaded_joints) {
    directions.col(long(joints.size())) = load.direction;
    joints.push_back(load.joint);
  }
  file.dataset("/layout/load_joints", H5T_NATIVE_INT, {joints.size()}, joints.data(), "1");
  file.dataset("/layout/load_directions", H5T_NATIVE_DOUBLE, {joints.size(), 3}, directions.data(),
               "1");
}

void write_layout(hdf5::Writer& file, const Layout& layout) {
  file.group("/layout");
  file.attribute("/layout", "spacing_mm", layout.spacing_mm);
  file.attribute("/layout", "rod_diameter_mm", layout.rod_diameter_mm);
  file.attribute("/layout", "length_scale_mm", layout.length_scale_mm);
  file.lists("/rods", layout.rods);
  file.dataset("/joints", joint_type(), {layout.joints.size()}, layout.joints.data(), "mm");
  file.dataset("/cells", cell_type(), {layout.cells.size()}, layout.cells.data(), "mm");
  file.dataset("/layout/edge_points", H5T_NATIVE_INT, {layout.edge_points.size()},
               layout.edge_points.data(), "1");
  // a 3 x n matrix by columns lies in memory as n x 3 by rows
  const auto boundary = [&](const char* name, const Eigen::Matrix3Xd& points) {
    file.dataset(name, H5T_NATIVE_DOUBLE, {static_cast<hsize_t>(points.cols()), 3}, points.data(),
                 "mm");
  };
  boundary("/layout/original_boundary", layout.original_boundary);
  boundary("/layout/actuated_boundary", layout.actuated_boundary);
  boundary("/layout/net_nodes", layout.net_nodes);
  boundary("/layout/flat_nodes", layout.flat_nodes);
  if (!layout.parts.empty()) write_parts(file, layout);
  if (!layout.loaded_joints.empty()) write_loads(file, layout);
}

void write_column(hdf5::Writer& file, const std::string& name, const char*,
                  const std::vector<std::string>& values) {
  file.strings(name, values);
}
template <class T>
void write_column(hdf5::Writer& file, const std::string& name, const char* unit,
                  const std::vector<T>& values) {
  file.dataset(name, memory_type(T{}), {values.size()}, values.data(), unit);
}

void write_column(hdf5::Writer& file, const FrameColumn& column, const std::vector<Frame>& frames) {
  static const Frame any;
  visit_column(column, any, [&]<class T>(const T&) {
    std::vector<T> values;
    for (const Frame& frame : frames)
      visit_column(column, frame, [&]<class U>(const U& value) {
        if constexpr (std::is_same_v<T, U>) values.push_back(value);
      });
    write_column(file, "/frames/" + column.name, column.unit, values);
  });
}

/// A frame without bins has unknown ones.
void write_bins(hdf5::Writer& file, const std::vector<Frame>& frames) {
  Eigen::Index bins = 0;
  for (const Frame& frame : frames) bins = std::max(bins, frame.K_bins.rows());
  if (bins == 0) return;
  std::vector<double> values;
  for (const Frame& frame : frames)
    for (Eigen::Index k = 0; k < bins; ++k)
      for (Eigen::Index column = 0; column < 3; ++column)
        values.push_back(k < frame.K_bins.rows() ? frame.K_bins(k, column) : unknown);
  file.dataset("/K_bins", H5T_NATIVE_DOUBLE, {frames.size(), static_cast<hsize_t>(bins), 3},
               values.data(), "rad, rad, cells");
}

void write_frames(hdf5::Writer& file, const std::vector<Frame>& frames, hsize_t cells) {
  const hsize_t count = frames.size();
  const hsize_t nodes = frames.empty() ? 0 : frames.front().nodes.cols();
  file.dataset("/nodes", H5T_NATIVE_DOUBLE, {count, nodes, 3}, nullptr, "mm");
  file.dataset("/cell_K", H5T_NATIVE_DOUBLE, {count, cells}, nullptr, "rad");
  for (hsize_t k = 0; k < count; ++k) {
    file.write_slice("/nodes", H5T_NATIVE_DOUBLE, k, frames[k].nodes.data());
    file.write_slice("/cell_K", H5T_NATIVE_DOUBLE, k, frames[k].cell_K.data());
  }
  write_bins(file, frames);
  file.group("/frames");
  for (const FrameColumn& column : frame_columns) write_column(file, column, frames);
  write_column(file, actuation_column, frames);
}

Eigen::Matrix3Xd read_points(hdf5::Reader& file, const std::string& name) {
  const Dims dims = file.dims(name, 2);
  if (!file.good()) return {};
  if (dims[1] != 3) file.fail_because(fmt::format("{} has {} coordinates a point", name, dims[1]));
  Eigen::Matrix3Xd points(3, file.good() ? dims[0] : 0);
  file.read(name, H5T_NATIVE_DOUBLE, points.data());
  return points;
}

void read_parts(hdf5::Reader& file, Layout& layout) {
  for (const std::string& name : file.strings("/parts/names")) {
    const std::string group = fmt::format("/parts/{}", layout.parts.size());
    layout.parts.push_back({name, file.lists(group + "/rods"), read_points(file, group + "/net"),
                            read_points(file, group + "/flat")});
  }
  const auto seams = file.strings("/parts/seams");
  const auto families = file.strings("/parts/families");
  const Dims dims = file.dims("/parts/seam_rods", 2);
  if (file.good() && (dims != Dims{seams.size(), 3} || families.size() != seams.size()))
    file.fail_because("/parts does not have one line, gap and kink a rod across a seam");
  std::vector<std::array<double, 3>> numbers(file.good() ? seams.size() : 0);
  file.read("/parts/seam_rods", H5T_NATIVE_DOUBLE, numbers.data());
  for (std::size_t k = 0; k < numbers.size(); ++k)
    layout.seam_rods.push_back(
        {seams[k], families[k] == "u" ? 'u' : 'v', numbers[k][0], numbers[k][1], numbers[k][2]});
}

void read_loads(hdf5::Reader& file, Layout& layout) {
  const auto joints = file.vector<int>("/layout/load_joints", H5T_NATIVE_INT);
  const Eigen::Matrix3Xd directions = read_points(file, "/layout/load_directions");
  if (file.good() && directions.cols() != long(joints.size()))
    file.fail_because("/layout has not one direction a joint that is pushed");
  for (std::size_t k = 0; file.good() && k < joints.size(); ++k)
    layout.loaded_joints.push_back({joints[k], directions.col(long(k))});
}

Layout read_layout(hdf5::Reader& file) {
  Layout layout;
  layout.spacing_mm = file.attribute("/layout", "spacing_mm");
  layout.rod_diameter_mm = file.attribute("/layout", "rod_diameter_mm");
  layout.length_scale_mm = file.attribute("/layout", "length_scale_mm");
  layout.rods = file.lists("/rods");
  layout.joints = file.vector<Joint>("/joints", joint_type());
  layout.cells = file.vector<Cell>("/cells", cell_type());
  layout.edge_points = file.vector<int>("/layout/edge_points", H5T_NATIVE_INT);
  layout.original_boundary = read_points(file, "/layout/original_boundary");
  layout.actuated_boundary = read_points(file, "/layout/actuated_boundary");
  layout.net_nodes = read_points(file, "/layout/net_nodes");
  layout.flat_nodes = read_points(file, "/layout/flat_nodes");
  if (file.has("/parts")) read_parts(file, layout);
  if (file.has("/layout/load_joints")) read_loads(file, layout);
  return layout;
}

void read_column(hdf5::Reader& file, const FrameColumn& column, std::vector<Frame>& frames) {
  const std::string name = "/frames/" + column.name;
  static const Frame any;
  visit_column(column, any, [&]<class T>(const T&) {
    std::vector<T> values;
    if constexpr (std::is_same_v<T, std::string>)
      values = file.strings(name);
    else
      values = file.vector<T>(name, memory_type(T{}));
    if (values.size() != frames.size())
      file.fail_because(
          fmt::format("{} has {} values for {} frames", name, values.size(), frames.size()));
    if (!file.good()) return;
    for (std::size_t k = 0; k < frames.size(); ++k)
      visit_column(column, frames[k], [&]<class U>(U& value) {
        if constexpr (std::is_same_v<T, U>) value = std::move(values[k]);
      });
  });
}

void read_bins(hdf5::Reader& file, std::vector<Frame>& frames) {
  if (!file.has("/K_bins")) return;
  const Dims dims = file.dims("/K_bins", 3);
  if (!file.good()) return;
  if (dims[0] != frames.size() || dims[2] != 3)
    return file.fail_because(fmt::format("/K_bins is {} x {} x {} for {} frames", dims[0], dims[1],
                                         dims[2], frames.size()));
  std::vector<double> values(dims[0] * dims[1] * dims[2]);
  file.read("/K_bins", H5T_NATIVE_DOUBLE, values.data());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Eigen::Index bins = static_cast<Eigen::Index>(dims[1]);
  for (std::size_t k = 0; k < frames.size(); ++k)
    frames[k].K_bins = Eigen::Map<const Rows>(values.data() + 3 * dims[1] * k, bins, 3);
}

std::vector<Frame> read_frames(hdf5::Reader& file) {
  const Dims nodes = file.dims("/nodes", 3), cells = file.dims("/cell_K", 2);
  if (!file.good()) return {};
  if (nodes[2] != 3 || cells[0] != nodes[0])
    file.fail_because(fmt::format("/nodes is {} x {} x {} and /cell_K {} x {}", nodes[0], nodes[1],
                                  nodes[2], cells[0], cells[1]));
  if (!file.good()) return {};
  std::vector<Frame> frames(nodes[0]);
  for (hsize_t k = 0; k < nodes[0] && file.good(); ++k) {
    frames[k].nodes.resize(3, nodes[1]);
    frames[k].cell_K.resize(cells[1]);
    file.read_slice("/nodes", H5T_NATIVE_DOUBLE, k, frames[k].nodes.data());
    file.read_slice("/cell_K", H5T_NATIVE_DOUBLE, k, frames[k].cell_K.data());
  }
  read_bins(file, frames);
  for (const FrameColumn& column : frame_columns) read_column(file, column, frames);
  read_column(file, actuation_column, frames);
  return frames;
}

}  // namespace

Result<void> write_trajectory(const std::filesystem::path& path, const Trajectory& trajectory) {
  if (auto fits = check_consistency(trajectory); !fits) return fits;
  std::size_t expected = 0;
  for (const Frame& frame : trajectory.frames)
    expected += sizeof(double) * (frame.nodes.size() + frame.cell_K.size());
  hdf5::Writer file(path.string(), expected);
  file.attribute("/", "format", format_name);
  write_layout(file, trajectory.layout);
  write_frames(file, trajectory.frames, trajectory.layout.cells.size());
  const std::string bytes = file.bytes();
  if (!file.good())
    return fail(Fault::io, fmt::format("cannot write '{}': {}", path.string(), file.reason()));
  return write_atomically(path, seal_of(bytes) + bytes);
}

Result<Trajectory> read_trajectory(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& reason) {
    return fail(Fault::bad_input,
                fmt::format("'{}' is no trajectory of a run: {}", path.string(), reason));
  };
  const auto bytes = read_whole(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto trusted = unsealed(*bytes);
  if (!trusted) return refuse(trusted.error().message);
  try {
    hdf5::Reader file(*trusted);
    if (!file.good()) return refuse("it is cut short or damaged");
    if (file.text_attribute("/", "format") != format_name)
      return refuse(fmt::format("it does not say \"{}\"", format_name));
    Trajectory trajectory;
    trajectory.layout = read_layout(file);
    trajectory.frames = read_frames(file);
    if (!file.good()) return refuse(file.reason());
    if (auto fits = check_consistency(trajectory); !fits) return refuse(fits.error().message);
    return trajectory;
  } catch (const std::bad_alloc&) {
    return refuse("it claims to hold more than fits into memory");
  }
}

}  // namespace gridshell::record
