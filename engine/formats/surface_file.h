// Surfaces in files of users: heights over a grid, triangle meshes.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/formats/point_file.h"
#include "engine/formats/shape_data.h"

namespace gridshell::preset {

/// Builds a triangle mesh from the vertices and polygons of a file. Errors start with `where`:
/// "dome.obj:17".
class MeshBuilder {
 public:
  static constexpr std::size_t most_vertices = 500000, most_triangles = 1000000;

  explicit MeshBuilder(double unit_mm) : unit_mm_(unit_mm) {}

  /// Number of vertices in the file, including those with equal positions.
  std::size_t vertices() const { return number_.size(); }
  /// Adds a vertex; vertices at equal positions are merged. Errors (bad_input): a coordinate that
  /// is not finite or above 1e9, too many vertices.
  Result<void> add_vertex(std::vector<double> xyz, const std::string& where);
  /// Adds a convex polygon as a fan of triangles, without those that have equal corners. `corners`:
  /// indices of vertices in the file, from 0. Errors (bad_input): fewer than three corners, a
  /// vertex that does not exist, too many triangles.
  Result<void> add_polygon(const std::vector<long>& corners, const std::string& where);
  /// The mesh. Errors (bad_input): there is no triangle.
  Result<SurfaceData> take(const std::string& name);

 private:
  double unit_mm_;
  SurfaceData mesh_;
  std::vector<int> number_;                // index in the mesh of every vertex of the file
  std::map<std::vector<double>, int> at_;  // index of the vertex at each position
};

/// Largest size of a file of a mesh, in bytes.
inline constexpr std::size_t largest_mesh_file = std::size_t(64) << 20;

/// Reads a file in the format of its name's ending: .csv and .txt contain heights, a point x, y, z
/// per line in any order (a table, table_file.h), at all nodes of a rectangular grid of 4 x 4 or
/// more; .obj, .ply and .stl contain triangles, with vertices at equal positions merged. Errors
/// (bad_input), with `name` and the line or the number of the element: text that is not of the
/// format, NaN, a node of the grid without a point or with two, more than 100 000 heights, 500 000
/// vertices or 1 000 000 triangles, another ending. `unit_mm` is the unit of a file that names
/// none.
Result<SurfaceData> read_surface(std::string_view bytes, const std::string& name,
                                 double unit_mm = 1);

/// The error in a surface that is part of a preset; empty: none.
std::string surface_error(const SurfaceData& surface);

}  // namespace gridshell::preset
