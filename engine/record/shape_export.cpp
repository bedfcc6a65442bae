#include "engine/record/shape_export.h"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/formats/csv.h"
#include "engine/record/frame_values.h"

namespace gridshell::exports {

Eigen::Matrix3Xd rod_points(const record::Layout& layout, const record::Frame& frame,
                            std::size_t rod) {
  const std::vector<int>& nodes = layout.rods[rod];
  Eigen::Matrix3Xd points(3, Eigen::Index(nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    points.col(Eigen::Index(k)) = frame.nodes.col(nodes[k]);
  return points;
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
    side = Eigen::Quaterniond::FromTwoVectors(tangent, next) * side;
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

/// A <DataArray> of numbers.
class VtkArray {
 public:
  VtkArray(std::string& text, const char* type, const char* name, int components = 1)
      : text_(text) {
    fmt::format_to(into(text_),
                   "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" "
                   "format=\"ascii\">\n",
                   type, name, components);
  }
  ~VtkArray() { text_ += "\n</DataArray>\n"; }
  VtkArray(const VtkArray&) = delete;
  VtkArray& operator=(const VtkArray&) = delete;

  void put(double value) { fmt::format_to(into(text_), "{} ", value); }
  void put(long value) { fmt::format_to(into(text_), "{} ", value); }
  void put(const Eigen::Vector3d& v) {
    fmt::format_to(into(text_), "{} {} {}\n", v.x(), v.y(), v.z());
  }

 private:
  std::string& text_;
};

std::vector<double> curvature_of(const record::Layout& layout, const record::Frame& frame,
                                 std::size_t rod) {
  return record::curvature_per_mm(layout, frame, rod);
}

/// Of the points of rods; the cells' corners have none.
void put_along_rods(const Shape& shape, const char* name, auto values_of, std::string& text) {
  VtkArray array(text, "Float64", name);
  for (std::size_t rod = 0; rod < shape.layout.rods.size(); ++rod)
    for (const double value : values_of(shape.layout, shape.frame, rod)) array.put(value);
  for (std::size_t k = 0; k < shape.layout.joints.size(); ++k) array.put(record::unknown);
}

/// What holds a joint stands once, at the cells' corner, not at both of its rods.
void put_reactions(const Shape& shape, std::string& text) {
  const Eigen::Matrix3Xd on = reactions_N(shape.layout, shape.frame);
  Eigen::Matrix3Xd on_rods = on;
  for (const record::Joint& joint : shape.layout.joints)
    if (on.col(joint.node).allFinite()) on_rods.col(joint.node).setZero();
  VtkArray array(text, "Float64", "reaction_N", 3);
  for (const auto& rod : shape.layout.rods)
    for (const int node : rod) array.put(Eigen::Vector3d(on_rods.col(node)));
  for (const record::Joint& joint : shape.layout.joints)
    array.put(Eigen::Vector3d(on.col(joint.node)));
}

/// Of one frame of a dataset of trajectory.h5, all of its `values`, of `components` each (0: one).
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

/// A topology that stands once in the file; later frames refer to the first one's.
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
  std::string text = "# " + shape.title + ", mm, z up\no gridshell\n";
  for (Eigen::Index k = 0; k < shape.frame.nodes.cols(); ++k)
    put_vertex(shape.frame.nodes.col(k), text);
  // joints once more, in their order: faces name them
  for (const record::Joint& joint : shape.layout.joints)
    put_vertex(shape.frame.nodes.col(joint.node), text);
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
  std::string text = "# " + shape.title + ", mm, z up\no gridshell\n";
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
  for (const record::Joint& joint : shape.layout.joints)
    put_vertex(shape.frame.nodes.col(joint.node), text);
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
  std::vector<Eigen::Matrix3Xd> rods;
  long points = 0;
  for (std::size_t rod = 0; rod < layout.rods.size(); ++rod) {
    rods.push_back(rod_points(layout, shape.frame, rod));
    points += rods.back().cols();
  }
  const long joints = long(layout.joints.size());
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<PolyData>\n<FieldData>\n<DataArray type=\"Float64\" "
      "Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n</FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n<PointData>\n",
      shape.frame.progress, points + joints, rods.size(), layout.cells.size());
  const auto moved = [&](int node) -> Eigen::Vector3d {
    return shape.frame.nodes.col(node) - shape.start.nodes.col(node);
  };
  {
    VtkArray array(text, "Float64", "displacement_mm", 3);
    for (const auto& rod : layout.rods)
      for (const int node : rod) array.put(moved(node));
    for (const record::Joint& joint : layout.joints) array.put(moved(joint.node));
  }
  put_along_rods(shape, "curvature_per_mm", curvature_of, text);
  put_along_rods(shape, "axial_force_N", record::axial_force_N, text);
  put_reactions(shape, text);
  text += "</PointData>\n<CellData>\n";
  {
    VtkArray array(text, "Int64", "rod");
    for (long rod = 0; rod < long(rods.size()); ++rod) array.put(rod);
    for (std::size_t k = 0; k < layout.cells.size(); ++k) array.put(-1L);
  }
  {
    VtkArray array(text, "Float64", "K_rad");
    for (std::size_t rod = 0; rod < rods.size(); ++rod) array.put(record::unknown);
    for (Eigen::Index k = 0; k < Eigen::Index(layout.cells.size()); ++k)
      array.put(k < shape.frame.cell_K.size() ? shape.frame.cell_K[k] : record::unknown);
  }
  text += "</CellData>\n<Points>\n";
  {
    VtkArray array(text, "Float64", "Points", 3);
    for (const auto& rod : rods)
      for (Eigen::Index k = 0; k < rod.cols(); ++k) array.put(Eigen::Vector3d(rod.col(k)));
    for (const record::Joint& joint : layout.joints)
      array.put(Eigen::Vector3d(shape.frame.nodes.col(joint.node)));
  }
  text += "</Points>\n<Lines>\n";
  {
    VtkArray array(text, "Int64", "connectivity");
    for (long k = 0; k < points; ++k) array.put(k);
  }
  {
    VtkArray array(text, "Int64", "offsets");
    long end = 0;
    for (const auto& rod : rods) array.put(end += rod.cols());
  }
  text += "</Lines>\n<Polys>\n";
  {
    VtkArray array(text, "Int64", "connectivity");
    for (const record::Cell& cell : layout.cells)
      for (const int joint : cell.joints) array.put(points + joint);
  }
  {
    VtkArray array(text, "Int64", "offsets");
    for (std::size_t k = 1; k <= layout.cells.size(); ++k) array.put(4 * long(k));
  }
  return text + "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string to_pvd(const std::vector<double>& progress, const std::vector<std::string>& files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (std::size_t k = 0; k < files.size(); ++k)
    fmt::format_to(into(text), "<DataSet timestep=\"{}\" file=\"{}\"/>\n", progress[k], files[k]);
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
  const long edge_count = record::edges_of_rods(layout), held = long(layout.supports.size());
  const bool forces = !frames.empty() && frames.back().axial_force_N.size() > 0;
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\" "
      "xmlns:xi=\"http://www.w3.org/2001/XInclude\">\n<Domain>\n"
      "<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const long index = long(k);
    const auto of = [&](const char* name, long values, long components) {
      return hyperslab(trajectory + ":" + name, index, frames.size(), values, components);
    };
    const std::string places =
        "<Geometry GeometryType=\"XYZ\">\n" + of("/nodes", nodes, 3) + "</Geometry>\n";
    fmt::format_to(into(text),
                   "<Grid Name=\"frame_{}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
                   "<Time Value=\"{}\"/>\n<Grid Name=\"rods_{}\">\n",
                   index, frames[k].progress, index);
    text += topology("rods", index, "Polyline", 2, edge_count, edges) + places;
    if (forces)
      text += "<Attribute Name=\"axial_force_N\" AttributeType=\"Scalar\" Center=\"Cell\">\n" +
              of("/axial_force_N", edge_count, 0) + "</Attribute>\n";
    text += "</Grid>\n";
    if (forces && held > 0) {
      fmt::format_to(into(text), "<Grid Name=\"supports_{}\">\n", index);
      text += topology("supports", index, "Polyvertex", 1, held, supports) + places;
      text += "<Attribute Name=\"reaction_N\" AttributeType=\"Vector\" Center=\"Cell\">\n" +
              of("/reactions_N", held, 3) + "</Attribute>\n</Grid>\n";
    }
    text += "</Grid>\n";
  }
  return text + "</Grid>\n</Domain>\n</Xdmf>\n";
}

std::string to_csv(const Shape& shape) {
  record::CsvWriter csv;
  csv.line("rod", "point", "x_mm", "y_mm", "z_mm", "curvature_per_mm", "axial_force_N",
           "reaction_x_N", "reaction_y_N", "reaction_z_N");
  const Eigen::Matrix3Xd on = reactions_N(shape.layout, shape.frame);
  for (std::size_t rod = 0; rod < shape.layout.rods.size(); ++rod) {
    const std::vector<int>& nodes = shape.layout.rods[rod];
    const auto curvature = curvature_per_mm(shape.layout, shape.frame, rod);
    const auto force = axial_force_N(shape.layout, shape.frame, rod);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Eigen::Vector3d at = shape.frame.nodes.col(nodes[k]), holds = on.col(nodes[k]);
      csv.line(int(rod), int(k), at.x(), at.y(), at.z(), curvature[k], force[k], holds.x(),
               holds.y(), holds.z());
    }
  }
  return std::move(csv).text();
}

}  // namespace gridshell::exports
