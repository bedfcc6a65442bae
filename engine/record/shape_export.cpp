#include "engine/record/shape_export.h"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "engine/core/dense.h"
#include "engine/core/text.h"
#include "engine/formats/csv.h"
#include "engine/record/frame_values.h"

namespace gridshell::exports {

Eigen::Matrix3Xd rod_points(const record::Layout& layout, const record::Frame& frame,
                            std::size_t rod) {
  return frame.nodes(Eigen::all, layout.rods[rod]);
}

std::vector<int> nodes_of_joints(const record::Layout& layout) {
  std::vector<int> nodes;
  for (const record::Joint& joint : layout.joints) nodes.push_back(joint.node);
  return nodes;
}

Eigen::Matrix3Xd reactions_N(const record::Layout& layout, const record::Frame& frame) {
  if (frame.reactions_N.size() == 0)
    return Eigen::Matrix3Xd::Constant(3, frame.nodes.cols(), record::unknown);
  Eigen::Matrix3Xd on = Eigen::Matrix3Xd::Zero(3, frame.nodes.cols());
  for (std::size_t k = 0; k < layout.supports.size(); ++k)
    on.col(layout.supports[k]) = frame.reactions_N.col(Eigen::Index(k));
  return on;
}

Eigen::Matrix<double, 3, 4> cell_corners(const record::Layout& layout, const record::Frame& frame,
                                         std::size_t cell) {
  Eigen::Matrix<double, 3, 4> corners;
  for (int k = 0; k < 4; ++k)
    corners.col(k) =
        frame.nodes.col(layout.joints[std::size_t(layout.cells[cell].joints[std::size_t(k)])].node);
  return corners;
}

Tube tube_around(const Eigen::Matrix3Xd& points, double radius_mm, int sides) {
  const Eigen::Index n = points.cols();
  Tube tube;
  tube.vertices.resize(3, n * sides + 2);
  tube.normals.resize(3, n * sides + 2);
  Eigen::Vector3d tangent = (points.col(1) - points.col(0)).normalized();
  Eigen::Vector3d side = tangent.unitOrthogonal();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Vector3d chord =
        points.col(std::min(k + 1, n - 1)) - points.col(std::max<Eigen::Index>(k - 1, 0));
    const Eigen::Vector3d next = chord.normalized();
    side = turn_between(tangent, next) * side;
    side = (side - side.dot(next) * next).normalized();
    tangent = next;
    const Eigen::Vector3d other = tangent.cross(side);
    for (int s = 0; s < sides; ++s) {
      const double angle = 2 * M_PI * s / sides;
      const Eigen::Vector3d normal = std::cos(angle) * side + std::sin(angle) * other;
      tube.normals.col(k * sides + s) = normal;
      tube.vertices.col(k * sides + s) = points.col(k) + radius_mm * normal;
    }
  }
  const int first = int(n) * sides, last = first + 1, ring = (int(n) - 1) * sides;
  tube.vertices.col(first) = points.col(0);
  tube.vertices.col(last) = points.col(n - 1);
  tube.normals.col(first) = (points.col(0) - points.col(1)).normalized();
  tube.normals.col(last) = (points.col(n - 1) - points.col(n - 2)).normalized();
  for (int s = 0; s < sides; ++s) {
    const int t = (s + 1) % sides;
    for (int k = 0; k + 1 < int(n); ++k) {
      const int a = k * sides + s, b = k * sides + t, c = a + sides, d = b + sides;
      tube.triangles.push_back({a, b, d});
      tube.triangles.push_back({a, d, c});
    }
    tube.triangles.push_back({first, t, s});
    tube.triangles.push_back({last, ring + s, ring + t});
  }
  return tube;
}

namespace {

constexpr int tube_sides = 8;

std::back_insert_iterator<std::string> into(std::string& text) { return std::back_inserter(text); }

/// The first lines of an OBJ file; a title of several lines becomes one.
std::string head_of_obj(std::string title) {
  std::ranges::replace_if(
      title, [](char c) { return (unsigned char)c < 0x20; }, ' ');
  return "# " + title + ", mm, z up\no gridshell\n";
}

void put_faces_of_cells(const record::Layout& layout, long first, std::string& text) {
  if (layout.cells.empty()) return;
  text += "g cells\n";
  for (const record::Cell& cell : layout.cells)
    fmt::format_to(into(text), "f {} {} {} {}\n", first + cell.joints[0], first + cell.joints[1],
                   first + cell.joints[2], first + cell.joints[3]);
}

void put_vertex(const Eigen::Vector3d& at, std::string& text) {
  fmt::format_to(into(text), "v {:.9f} {:.9f} {:.9f}\n", at.x(), at.y(), at.z());
}

/// Appends a <DataArray> of numbers or vectors.
void put_array(std::string& text, const char* type, const char* name, int components,
               const std::string& values) {
  fmt::format_to(into(text),
                 "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
                 "format=\"ascii\">\n{}\n</DataArray>\n",
                 type, name, components, values);
}
template <class Number>
void put_array(std::string& text, const char* name, const std::vector<Number>& values) {
  std::string numbers;
  for (const Number value : values) fmt::format_to(into(numbers), "{} ", value);
  put_array(text, std::is_same_v<Number, double> ? "Float64" : "Int64", name, 1, numbers);
}
void put_array(std::string& text, const char* name, const Eigen::Matrix3Xd& values) {
  std::string vectors;
  for (const auto& v : values.colwise())
    fmt::format_to(into(vectors), "{} {} {}\n", v.x(), v.y(), v.z());
  put_array(text, "Float64", name, 3, vectors);
}

/// Values at all points of a VTK file: those of the rods, then NaN for the cells' corners.
std::vector<double> along_rods(const Shape& shape, auto values_of) {
  std::vector<double> all;
  for (std::size_t rod = 0; rod < shape.layout.rods.size(); ++rod) {
    const std::vector<double> values = values_of(shape.layout, shape.frame, rod);
    all.insert(all.end(), values.begin(), values.end());
  }
  all.insert(all.end(), shape.layout.joints.size(), record::unknown);
  return all;
}

/// The XDMF item for one frame of a dataset of trajectory.h5: `values` entries of `components`
/// numbers each; 0: of one number, in a dataset with two dimensions.
std::string hyperslab(const std::string& dataset, long index, std::size_t frames, long values,
                      long components) {
  const auto dims = [&](long first) {
    return components == 0 ? fmt::format("{} {}", first, values)
                           : fmt::format("{} {} {}", first, values, components);
  };
  const bool deep = components > 0;
  return fmt::format(
      "<DataItem ItemType=\"HyperSlab\" Type=\"HyperSlab\" Dimensions=\"{}\">\n<DataItem "
      "Dimensions=\"3 {}\" NumberType=\"Int\" Format=\"XML\">{} {}  {}  {}</DataItem>\n"
      "<DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"{}\">{}"
      "</DataItem>\n</DataItem>\n",
      dims(1), deep ? 3 : 2, index, deep ? "0 0" : "0", deep ? "1 1 1" : "1 1", dims(1),
      dims(long(frames)), dataset);
}

/// The XDMF topology of a frame: written for the first frame, to which the others refer.
std::string topology(const std::string& grid, long index, const char* type, int nodes,
                     long elements, const std::string& numbers) {
  if (index > 0)
    return fmt::format(
        "<xi:include xpointer='xpointer(//Grid[@Name=\"{}_0\"]/*[self::Topology])'/>\n", grid);
  return fmt::format(
      "<Topology TopologyType=\"{}\" NodesPerElement=\"{}\" NumberOfElements=\"{}\">\n<DataItem "
      "Format=\"XML\" NumberType=\"Int\" Dimensions=\"{} {}\">\n{}</DataItem>\n</Topology>\n",
      type, nodes, elements, elements, nodes, numbers);
}

}  // namespace

std::string to_obj(const Shape& shape) {
  std::string text = head_of_obj(shape.title);
  for (Eigen::Index k = 0; k < shape.frame.nodes.cols(); ++k)
    put_vertex(shape.frame.nodes.col(k), text);
  // joints again, in their order: points and faces refer to these
  for (const int node : nodes_of_joints(shape.layout))
    put_vertex(shape.frame.nodes.col(node), text);
  text += "g rods\n";
  for (const auto& rod : shape.layout.rods) {
    text += "l";
    for (const int node : rod) fmt::format_to(into(text), " {}", node + 1);
    text += "\n";
  }
  const long joints = shape.frame.nodes.cols() + 1;
  text += "g joints\n";
  for (std::size_t k = 0; k < shape.layout.joints.size(); ++k)
    fmt::format_to(into(text), "p {}\n", joints + long(k));
  put_faces_of_cells(shape.layout, joints, text);
  return text;
}

std::string to_obj_tubes(const Shape& shape) {
  std::string text = head_of_obj(shape.title);
  long first = 1;
  for (std::size_t rod = 0; rod < shape.layout.rods.size(); ++rod) {
    const Tube tube = tube_around(rod_points(shape.layout, shape.frame, rod),
                                  record::diameter_of(shape.layout, rod) / 2, tube_sides);
    fmt::format_to(into(text), "g rod_{}\n", rod);
    for (Eigen::Index k = 0; k < tube.vertices.cols(); ++k) put_vertex(tube.vertices.col(k), text);
    for (Eigen::Index k = 0; k < tube.normals.cols(); ++k)
      fmt::format_to(into(text), "vn {:.5f} {:.5f} {:.5f}\n", tube.normals(0, k),
                     tube.normals(1, k), tube.normals(2, k));
    for (const auto& [a, b, c] : tube.triangles)
      fmt::format_to(into(text), "f {0}//{0} {1}//{1} {2}//{2}\n", first + a, first + b, first + c);
    first += tube.vertices.cols();
  }
  for (const int node : nodes_of_joints(shape.layout))
    put_vertex(shape.frame.nodes.col(node), text);
  put_faces_of_cells(shape.layout, first, text);
  return text;
}

Drawing rods_in_space(const Shape& shape) {
  Layer rods{"rods", 7}, boundary{"boundary", 1};
  for (std::size_t rod = 0; rod < shape.layout.rods.size(); ++rod) {
    const Eigen::Matrix3Xd points = rod_points(shape.layout, shape.frame, rod);
    DrawnLine line;
    for (Eigen::Index k = 0; k < points.cols(); ++k) line.points.push_back(points.col(k));
    rods.lines.push_back(std::move(line));
  }
  DrawnLine ring{{}, true};
  const auto& [from, to] = std::tie(shape.layout.original_boundary, shape.layout.actuated_boundary);
  for (Eigen::Index k = 0; k < std::min(from.cols(), to.cols()); ++k)
    ring.points.push_back(from.col(k) + shape.frame.actuation * (to.col(k) - from.col(k)));
  if (!ring.points.empty()) boundary.lines.push_back(std::move(ring));
  return {shape.title, {rods, boundary}};
}

std::string to_vtp(const Shape& shape) {
  const record::Layout& layout = shape.layout;
  const std::vector<int> joints = nodes_of_joints(layout);
  // points of rods, each with its own, then the cells' corners
  std::vector<int> nodes;
  std::vector<long> rod_of(layout.rods.size()), rod_ends, cell_ends, corners;
  for (const auto& rod : layout.rods) {
    nodes.insert(nodes.end(), rod.begin(), rod.end());
    rod_ends.push_back(long(nodes.size()));
  }
  const std::size_t points = nodes.size();
  nodes.insert(nodes.end(), joints.begin(), joints.end());
  for (const record::Cell& cell : layout.cells) {
    for (const int joint : cell.joints) corners.push_back(long(points) + joint);
    cell_ends.push_back(long(corners.size()));
  }
  std::vector<long> in_order(points);
  std::iota(in_order.begin(), in_order.end(), 0);
  std::iota(rod_of.begin(), rod_of.end(), 0);
  rod_of.resize(rod_of.size() + layout.cells.size(), -1);
  std::vector<double> K(layout.rods.size(), record::unknown);
  K.insert(K.end(), shape.frame.cell_K.begin(), shape.frame.cell_K.end());
  K.resize(rod_of.size(), record::unknown);
  // a joint's reaction is written once, at the cells' corner, not at both of its rods
  const Eigen::Matrix3Xd on = reactions_N(layout, shape.frame);
  Eigen::Matrix3Xd on_rods = on;
  for (const int node : joints)
    if (on.col(node).allFinite()) on_rods.col(node).setZero();
  Eigen::Matrix3Xd reactions = on(Eigen::all, nodes);
  reactions.leftCols(long(points)) = on_rods(Eigen::all, nodes).leftCols(long(points));

  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<PolyData>\n<FieldData>\n<DataArray type=\"Float64\" "
      "Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n</FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n<PointData>\n",
      shape.frame.progress, nodes.size(), layout.rods.size(), layout.cells.size());
  const Eigen::Matrix3Xd moved = shape.frame.nodes - shape.start.nodes;
  put_array(text, "displacement_mm", Eigen::Matrix3Xd(moved(Eigen::all, nodes)));
  put_array(text, "curvature_per_mm",
            along_rods(shape, [](const auto&... of) { return record::curvature_per_mm(of...); }));
  put_array(text, "axial_force_N", along_rods(shape, record::axial_force_N));
  put_array(text, "stress_MPa", along_rods(shape, record::stress_MPa));
  put_array(text, "reaction_N", reactions);
  text += "</PointData>\n<CellData>\n";
  put_array(text, "rod", rod_of);
  put_array(text, "K_rad", K);
  text += "</CellData>\n<Points>\n";
  put_array(text, "Points", Eigen::Matrix3Xd(shape.frame.nodes(Eigen::all, nodes)));
  text += "</Points>\n<Lines>\n";
  put_array(text, "connectivity", in_order);
  put_array(text, "offsets", rod_ends);
  text += "</Lines>\n<Polys>\n";
  put_array(text, "connectivity", corners);
  put_array(text, "offsets", cell_ends);
  return text + "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string to_pvd(const std::vector<double>& progress, const std::vector<std::string>& files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (std::size_t k = 0; k < files.size(); ++k)
    fmt::format_to(into(text), "<DataSet timestep=\"{}\" file=\"{}\"/>\n", progress[k],
                   escape_xml(files[k]));
  return text + "</Collection>\n</VTKFile>\n";
}

std::string to_xdmf(const record::Layout& layout, const record::FrameList& frames,
                    const std::string& trajectory) {
  std::string edges, supports;
  for (const auto& rod : layout.rods)
    for (std::size_t k = 1; k < rod.size(); ++k)
      fmt::format_to(into(edges), "{} {}\n", rod[k - 1], rod[k]);
  for (const int node : layout.supports) fmt::format_to(into(supports), "{}\n", node);
  const long nodes = frames.empty() ? 0 : long(frames.front().nodes.cols());
  const long edge_count = record::edges_of_rods(layout), supported = long(layout.supports.size());
  const bool forces = !frames.empty() && frames.back().axial_force_N.size() > 0;
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\" "
      "xmlns:xi=\"http://www.w3.org/2001/XInclude\">\n<Domain>\n"
      "<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const long index = long(k);
    const auto of = [&](const char* name, long values, long components) {
      return hyperslab(escape_xml(trajectory) + ":" + name, index, frames.size(), values,
                       components);
    };
    const std::string geometry =
        "<Geometry GeometryType=\"XYZ\">\n" + of("/nodes", nodes, 3) + "</Geometry>\n";
    fmt::format_to(into(text),
                   "<Grid Name=\"frame_{}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
                   "<Time Value=\"{}\"/>\n<Grid Name=\"rods_{}\">\n",
                   index, frames[k].progress, index);
    text += topology("rods", index, "Polyline", 2, edge_count, edges) + geometry;
    if (forces)
      text += "<Attribute Name=\"axial_force_N\" AttributeType=\"Scalar\" Center=\"Cell\">\n" +
              of("/axial_force_N", edge_count, 0) + "</Attribute>\n";
    text += "</Grid>\n";
    if (forces && supported > 0) {
      fmt::format_to(into(text), "<Grid Name=\"supports_{}\">\n", index);
      text += topology("supports", index, "Polyvertex", 1, supported, supports) + geometry;
      text += "<Attribute Name=\"reaction_N\" AttributeType=\"Vector\" Center=\"Cell\">\n" +
              of("/reactions_N", supported, 3) + "</Attribute>\n</Grid>\n";
    }
    text += "</Grid>\n";
  }
  return text + "</Grid>\n</Domain>\n</Xdmf>\n";
}

std::string to_csv(const Shape& shape) {
  record::CsvWriter csv;
  csv.line("rod", "point", "x_mm", "y_mm", "z_mm", "curvature_per_mm", "axial_force_N",
           "stress_MPa", "reaction_x_N", "reaction_y_N", "reaction_z_N");
  const Eigen::Matrix3Xd on = reactions_N(shape.layout, shape.frame);
  for (std::size_t rod = 0; rod < shape.layout.rods.size(); ++rod) {
    const std::vector<int>& nodes = shape.layout.rods[rod];
    const auto curvature = curvature_per_mm(shape.layout, shape.frame, rod);
    const auto force = axial_force_N(shape.layout, shape.frame, rod);
    const auto stress = stress_MPa(shape.layout, shape.frame, rod);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Eigen::Vector3d at = shape.frame.nodes.col(nodes[k]), reaction = on.col(nodes[k]);
      csv.line(int(rod), int(k), at.x(), at.y(), at.z(), curvature[k], force[k], stress[k],
               reaction.x(), reaction.y(), reaction.z());
    }
  }
  return std::move(csv).text();
}

}  // namespace gridshell::exports
