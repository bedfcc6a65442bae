// A triangle mesh while its file is read: what every format checks alike.
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

  /// Of the file, those at one place counted each.
  std::size_t vertices() const { return number_.size(); }
  /// Vertices at one place become one. Errors (bad_input): a coordinate that is not finite or above
  /// 1e9, too many.
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
  std::map<std::vector<double>, int> at_;  // the vertex at a place
};

// Surfaces in files that a user brings: heights over a grid, meshes of triangles.

/// The largest file of a mesh that is read.
inline constexpr std::size_t largest_mesh_file = std::size_t(64) << 20;

/// Reads a file as its name's ending says: .csv and .txt hold heights, a point x, y, z a line in
/// any order (a table, table_file.h), at all places of a rectangular grid of 4 x 4 or more; .obj,
/// .ply and .stl triangles, vertices at one place being one. Errors (bad_input), with `name` and
/// the line or the number of what is wrong: not of the format, NaN, a place of the grid without a
/// point or with two, more than 100 000 points or 200 000 triangles, another ending. `unit_mm` is
/// the unit of a file that names none.
Result<SurfaceData> read_surface(std::string_view bytes, const std::string& name,
                                 double unit_mm = 1);

/// What is wrong with a surface that a preset holds itself; empty: nothing.
std::string surface_fault(const SurfaceData& surface);

}  // namespace gridshell::preset
