// A triangle mesh while its file is read: checks that all formats share.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/formats/point_file.h"
#include "engine/formats/shape_data.h"

namespace gridshell::preset {

/// Gathers vertices and polygons; `place` begins every error: "dome.obj:17".
class MeshBuilder {
 public:
  static constexpr std::size_t most_vertices = 500000, most_triangles = 1000000;

  explicit MeshBuilder(double unit_mm) : unit_mm_(unit_mm) {}

  /// Number of vertices in the file, including those with equal positions.
  std::size_t vertices() const { return number_.size(); }
  /// Adds a vertex; vertices at equal positions become one. Errors (bad_input): a coordinate that
  /// is not finite or above 1e9, too many vertices.
  Result<void> add_vertex(std::vector<double> xyz, const std::string& place);
  /// A convex polygon by its vertices as the file counts them, from 0; it becomes a fan without
  /// triangles whose corners are one. Errors (bad_input): fewer than three corners, a vertex that
  /// is not there, too many.
  Result<void> add_polygon(const std::vector<long>& corners, const std::string& place);
  /// Errors (bad_input): there is no triangle.
  Result<SurfaceData> take(const std::string& name);

 private:
  double unit_mm_;
  SurfaceData mesh_;
  std::vector<int> number_;                // in the mesh, of every vertex of the file
  std::map<std::vector<double>, int> at_;  // the vertex at a position
};

// Surfaces in files that a user brings: heights over a grid, meshes of triangles.

/// The largest file of a mesh that is read.
inline constexpr std::size_t largest_mesh_file = std::size_t(64) << 20;

/// Reads a file in the format of its name's ending: .csv and .txt contain heights, a point x, y, z
/// per line in any order (a table, table_file.h), at all nodes of a rectangular grid of 4 x 4 or
/// more; .obj, .ply and .stl contain triangles, with vertices at equal positions merged. Errors
/// (bad_input), with `name` and the line or the number of the element: text that is not of the
/// format, NaN, a node of the grid without a point or with two, more than 100 000 points or 200 000
/// triangles, another ending. `unit_mm` is the unit of a file that names none.
Result<SurfaceData> read_surface(std::string_view bytes, const std::string& name,
                                 double unit_mm = 1);

/// The error in a surface that is part of a preset; empty: none.
std::string surface_error(const SurfaceData& surface);

}  // namespace gridshell::preset
