#include "engine/export/formats.h"

#include <fmt/format.h>

#include <iterator>

#include "engine/record/csv.h"

namespace gridshell::exports {
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
                                  shape.layout.rod_diameter_mm / 2, tube_sides);
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
  {
    VtkArray array(text, "Float64", "curvature_per_mm");
    for (const auto& rod : rods)
      for (const double curvature : curvature_per_mm(rod)) array.put(curvature);
    // cells have none
    for (long k = 0; k < joints; ++k) array.put(0.0);
  }
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
  std::string edges;
  long count = 0;
  for (const auto& rod : layout.rods)
    for (std::size_t k = 1; k < rod.size(); ++k, ++count)
      fmt::format_to(into(edges), "{} {}\n", rod[k - 1], rod[k]);
  const long nodes = frames.empty() ? 0 : long(frames.front().nodes.cols());
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\" "
      "xmlns:xi=\"http://www.w3.org/2001/XInclude\">\n<Domain>\n"
      "<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  long index = 0;
  for (const record::Frame& frame : frames) {
    fmt::format_to(into(text), "<Grid Name=\"frame_{}\">\n<Time Value=\"{}\"/>\n", index,
                   frame.progress);
    if (index == 0)
      fmt::format_to(into(text),
                     "<Topology TopologyType=\"Polyline\" NodesPerElement=\"2\" "
                     "NumberOfElements=\"{0}\">\n<DataItem Format=\"XML\" NumberType=\"Int\" "
                     "Dimensions=\"{0} 2\">\n{1}</DataItem>\n</Topology>\n",
                     count, edges);
    else
      text += "<xi:include xpointer='xpointer(//Grid[@Name=\"frame_0\"]/*[self::Topology])'/>\n";
    fmt::format_to(into(text),
                   "<Geometry GeometryType=\"XYZ\">\n<DataItem ItemType=\"HyperSlab\" "
                   "Type=\"HyperSlab\" Dimensions=\"1 {0} 3\">\n<DataItem Dimensions=\"3 3\" "
                   "NumberType=\"Int\" "
                   "Format=\"XML\">{1} 0 0  1 1 1  1 {0} 3</DataItem>\n<DataItem Format=\"HDF\" "
                   "NumberType=\"Float\" Precision=\"8\" Dimensions=\"{2} {0} 3\">{3}:/nodes"
                   "</DataItem>\n</DataItem>\n</Geometry>\n</Grid>\n",
                   nodes, index, frames.size(), trajectory);
    ++index;
  }
  return text + "</Grid>\n</Domain>\n</Xdmf>\n";
}

std::string to_csv(const Shape& shape) {
  record::Csv csv;
  csv.line("rod", "point", "x_mm", "y_mm", "z_mm", "curvature_per_mm");
  for (std::size_t rod = 0; rod < shape.layout.rods.size(); ++rod) {
    const Eigen::Matrix3Xd points = rod_points(shape.layout, shape.frame, rod);
    const auto curvature = curvature_per_mm(points);
    for (Eigen::Index k = 0; k < points.cols(); ++k)
      csv.line(int(rod), int(k), points(0, k), points(1, k), points(2, k),
               curvature[std::size_t(k)]);
  }
  return std::move(csv).text();
}

}  // namespace gridshell::exports
