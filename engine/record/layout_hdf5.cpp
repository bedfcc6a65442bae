#include "engine/record/trajectory_hdf5.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "engine/core/fields.h"

namespace gridshell::record {
namespace {

using hdf5::Dims;
using hdf5::Handle;

Handle type_of(int) { return Handle(H5Tcopy(H5T_NATIVE_INT), H5Tclose); }
Handle type_of(double) { return Handle(H5Tcopy(H5T_NATIVE_DOUBLE), H5Tclose); }

Handle type_of(const Joint&) {
  Handle type(H5Tcreate(H5T_COMPOUND, sizeof(Joint)), H5Tclose);
  H5Tinsert(type, "i", HOFFSET(Joint, i), H5T_NATIVE_INT);
  H5Tinsert(type, "j", HOFFSET(Joint, j), H5T_NATIVE_INT);
  H5Tinsert(type, "u_mm", HOFFSET(Joint, u_mm), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "v_mm", HOFFSET(Joint, v_mm), H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "node", HOFFSET(Joint, node), H5T_NATIVE_INT);
  return type;
}

Handle type_of(const Cell&) {
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

template <class Value>
void put(hdf5::Writer& file, const std::string& name, const std::vector<Value>& values,
         const char* unit) {
  file.dataset(name, type_of(Value{}), {values.size()}, values.data(), unit);
}
void put(hdf5::Writer& file, const std::string& name, const std::vector<std::string>& values,
         const char*) {
  file.strings(name, values);
}
void put(hdf5::Writer& file, const std::string& name, const hdf5::Lists& lists, const char*) {
  file.lists(name, lists);
}
// in memory a 3 x n matrix stored by columns is equal to an n x 3 matrix stored by rows
void put(hdf5::Writer& file, const std::string& name, const Eigen::Matrix3Xd& points,
         const char* unit) {
  file.dataset(name, H5T_NATIVE_DOUBLE, {hsize_t(points.cols()), 3}, points.data(), unit);
}

template <class Value>
void take(hdf5::Reader& file, const std::string& name, std::vector<Value>& values) {
  values = file.vector<Value>(name, type_of(Value{}));
}
void take(hdf5::Reader& file, const std::string& name, std::vector<std::string>& values) {
  values = file.strings(name);
}
void take(hdf5::Reader& file, const std::string& name, hdf5::Lists& lists) {
  lists = file.lists(name);
}
void take(hdf5::Reader& file, const std::string& name, Eigen::Matrix3Xd& points) {
  const Dims dims = file.dims(name, 2);
  if (!file.good()) return;
  if (dims[1] != 3) file.fail_because(fmt::format("{} has {} coordinates a point", name, dims[1]));
  points.resize(3, file.good() ? Eigen::Index(dims[0]) : 0);
  file.read(name, H5T_NATIVE_DOUBLE, points.data());
}

enum Presence { always, where_known };

/// Calls visit(name, member, unit, presence) for every member that is stored as one dataset.
template <RecordOf<Layout> LayoutType, class Visit>
void each_dataset(LayoutType& layout, const Visit& visit) {
  visit("/layout/diameters", layout.diameters_mm, "mm", where_known);
  visit("/layout/laths", layout.laths_mm, "mm", where_known);
  visit("/layout/strength", layout.strength_MPa, "MPa", where_known);
  visit("/rods", layout.rods, "1", always);
  visit("/layout/families", layout.families, "", where_known);
  visit("/layout/supports", layout.supports, "1", where_known);
  visit("/layout/sprung", layout.sprung, "1", where_known);
  visit("/layout/spring_stiffness", layout.spring_N_per_mm, "N/mm", where_known);
  visit("/joints", layout.joints, "mm", always);
  visit("/layout/above", layout.above, "1", where_known);
  visit("/cells", layout.cells, "mm", always);
  visit("/layout/edge_points", layout.edge_points, "1", always);
  visit("/layout/original_boundary", layout.original_boundary, "mm", always);
  visit("/layout/actuated_boundary", layout.actuated_boundary, "mm", always);
  visit("/layout/net_nodes", layout.net_nodes, "mm", always);
  visit("/layout/flat_nodes", layout.flat_nodes, "mm", always);
}

/// Calls visit(name, member) for the members that are stored as attributes.
template <RecordOf<Layout> LayoutType, class Visit>
void each_attribute(LayoutType& layout, const Visit& visit) {
  GRIDSHELL_VISIT(visit, layout.spacing_mm, layout.rod_diameter_mm, layout.length_scale_mm);
}

/// Attributes for the search for contacts, which older versions did not write.
template <RecordOf<Layout> LayoutType, class Visit>
void each_contact_attribute(LayoutType& layout, const Visit& visit) {
  GRIDSHELL_VISIT(visit, layout.joint_diameter_mm, layout.joint_height_mm, layout.table_mm);
}

/// The datasets of a building block in its group.
template <RecordOf<Part> PartType, class Visit>
void each_dataset(PartType& part, const Visit& visit) {
  visit("/rods", part.rods, "1");
  visit("/net", part.net, "mm");
  visit("/flat", part.flat, "mm");
}

void write_parts(hdf5::Writer& file, const Layout& layout) {
  std::vector<std::string> names, seams, families;
  std::vector<std::array<double, 3>> numbers;
  file.group("/parts");
  for (const Part& part : layout.parts) {
    const std::string group = fmt::format("/parts/{}", names.size());
    names.push_back(part.name);
    file.group(group);
    each_dataset(part, [&](const char* name, const auto& values, const char* unit) {
      put(file, group + name, values, unit);
    });
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

void read_parts(hdf5::Reader& file, Layout& layout) {
  for (const std::string& name : file.strings("/parts/names")) {
    const std::string group = fmt::format("/parts/{}", layout.parts.size());
    each_dataset(
        layout.parts.emplace_back(Part{name, {}, {}, {}}),
        [&](const char* of, auto& values, const char*) { take(file, group + of, values); });
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

void write_loads(hdf5::Writer& file, const Layout& layout) {
  std::vector<int> joints, at_times;
  Eigen::Matrix3Xd directions(3, layout.loaded_joints.size());
  for (const LoadedJoint& load : layout.loaded_joints) {
    directions.col(long(joints.size())) = load.direction;
    joints.push_back(load.joint);
    at_times.push_back(load.at_times);
  }
  put(file, "/layout/load_joints", joints, "1");
  if (std::ranges::count(at_times, 0) < long(at_times.size()))
    put(file, "/layout/load_at_times", at_times, "1");
  put(file, "/layout/load_directions", directions, "1");
}

void read_loads(hdf5::Reader& file, Layout& layout) {
  std::vector<int> joints;
  Eigen::Matrix3Xd directions;
  take(file, "/layout/load_joints", joints);
  take(file, "/layout/load_directions", directions);
  std::vector<int> at_times(joints.size(), 0);  // older versions did not write it
  if (file.has("/layout/load_at_times")) take(file, "/layout/load_at_times", at_times);
  if (file.good() && directions.cols() != long(joints.size()))
    file.fail_because("/layout has not one direction a joint that is pushed");
  if (file.good() && at_times.size() != joints.size())
    file.fail_because("/layout/load_at_times has not one number a joint that is pushed");
  for (std::size_t k = 0; file.good() && k < joints.size(); ++k)
    layout.loaded_joints.push_back({joints[k], directions.col(long(k)), at_times[k] != 0});
}

}  // namespace

void write_layout(hdf5::Writer& file, const Layout& layout) {
  file.group("/layout");
  const auto write = [&](const char* name, double value) {
    file.attribute("/layout", name, value);
  };
  each_attribute(layout, write);
  each_contact_attribute(layout, write);
  each_dataset(layout, [&](const char* name, const auto& values, const char* unit, Presence when) {
    if (when == always || values.size() > 0) put(file, name, values, unit);
  });
  if (!layout.parts.empty()) write_parts(file, layout);
  if (!layout.loaded_joints.empty()) write_loads(file, layout);
}

Layout read_layout(hdf5::Reader& file) {
  Layout layout;
  each_attribute(layout,
                 [&](const char* name, double& value) { value = file.attribute("/layout", name); });
  each_contact_attribute(layout, [&](const char* name, double& value) {
    value = file.attribute_or("/layout", name, value);
  });
  each_dataset(layout, [&](const char* name, auto& values, const char*, Presence when) {
    if (when == always || file.has(name)) take(file, name, values);
  });
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
  if (!file.good()) return invalid(file.reason());
  return layout;
}

}  // namespace gridshell::record
