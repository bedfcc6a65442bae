#include "engine/record/trajectory_hdf5.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace gridshell::record {
namespace {

using hdf5::Dims;
using hdf5::Handle;

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
  std::vector<int> joints, at_times;
  Eigen::Matrix3Xd directions(3, layout.loaded_joints.size());
  for (const LoadedJoint& load : layout.loaded_joints) {
    directions.col(long(joints.size())) = load.direction;
    joints.push_back(load.joint);
    at_times.push_back(load.at_times);
  }
  file.dataset("/layout/load_joints", H5T_NATIVE_INT, {joints.size()}, joints.data(), "1");
  if (std::ranges::count(at_times, 0) < long(at_times.size()))
    file.dataset("/layout/load_at_times", H5T_NATIVE_INT, {joints.size()}, at_times.data(), "1");
  file.dataset("/layout/load_directions", H5T_NATIVE_DOUBLE, {joints.size(), 3}, directions.data(),
               "1");
}

}  // namespace

void write_layout(hdf5::Writer& file, const Layout& layout) {
  file.group("/layout");
  file.attribute("/layout", "spacing_mm", layout.spacing_mm);
  file.attribute("/layout", "rod_diameter_mm", layout.rod_diameter_mm);
  file.attribute("/layout", "length_scale_mm", layout.length_scale_mm);
  if (!layout.diameters_mm.empty())
    file.dataset("/layout/diameters", H5T_NATIVE_DOUBLE, {layout.diameters_mm.size()},
                 layout.diameters_mm.data(), "mm");
  file.lists("/rods", layout.rods);
  if (!layout.families.empty()) file.strings("/layout/families", layout.families);
  if (!layout.supports.empty())
    file.dataset("/layout/supports", H5T_NATIVE_INT, {layout.supports.size()},
                 layout.supports.data(), "1");
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

namespace {

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
  std::vector<int> at_times(joints.size(), 0);  // as older versions wrote
  if (file.has("/layout/load_at_times"))
    at_times = file.vector<int>("/layout/load_at_times", H5T_NATIVE_INT);
  if (file.good() && at_times.size() != joints.size())
    file.fail_because("/layout/load_at_times has not one number a joint that is pushed");
  for (std::size_t k = 0; file.good() && k < joints.size(); ++k)
    layout.loaded_joints.push_back({joints[k], directions.col(long(k)), at_times[k] != 0});
}

}  // namespace

Layout read_layout(hdf5::Reader& file) {
  Layout layout;
  layout.spacing_mm = file.attribute("/layout", "spacing_mm");
  layout.rod_diameter_mm = file.attribute("/layout", "rod_diameter_mm");
  layout.length_scale_mm = file.attribute("/layout", "length_scale_mm");
  if (file.has("/layout/diameters"))
    layout.diameters_mm = file.vector<double>("/layout/diameters", H5T_NATIVE_DOUBLE);
  layout.rods = file.lists("/rods");
  if (file.has("/layout/families")) layout.families = file.strings("/layout/families");
  if (file.has("/layout/supports"))
    layout.supports = file.vector<int>("/layout/supports", H5T_NATIVE_INT);
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

std::string image_of(const Layout& layout) {
  hdf5::Writer file(fmt::format("layout {}", static_cast<const void*>(&layout)));
  write_layout(file, layout);
  return file.bytes();
}

Result<Layout> layout_of_image(std::string_view bytes) {
  hdf5::Reader file(bytes);
  Layout layout = read_layout(file);
  if (!file.good()) return fail(Fault::bad_input, file.reason());
  return layout;
}

}  // namespace gridshell::record
