// A triangle mesh while its file is read: what every format checks alike.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/preset/point_file.h"
#include "engine/preset/points.h"

namespace gridshell::preset {

/// The words of a line, apart by blanks.
std::vector<std::string_view> blank_apart(std::string_view line);
/// The next line of a text, without its end; the text goes on behind it.
std::string_view next_line(std::string_view& text);

/// Gathers vertices and polygons; `place` begins every error: "dome.obj:17".
class MeshDraft {
 public:
  static constexpr std::size_t most_vertices = 100000, most_triangles = 200000;

  /// Of the file, those at one place counted each.
  std::size_t vertices() const { return number_.size(); }
  /// Vertices at one place become one. Errors (bad_input): a coordinate that is not finite or above
  /// 1e9, too many.
  Result<void> add_vertex(const std::vector<double>& xyz, const std::string& place);
  /// A convex polygon by its vertices as the file counts them, from 0; it becomes a fan without
  /// triangles whose corners are one. Errors (bad_input): fewer than three corners, a vertex that
  /// is not there, too many.
  Result<void> add_polygon(const std::vector<long>& corners, const std::string& place);
  /// Errors (bad_input): there is no triangle.
  Result<SurfaceData> take(const std::string& name);

 private:
  SurfaceData mesh_;
  std::vector<int> number_;                // in the mesh, of every vertex of the file
  std::map<std::vector<double>, int> at_;  // the vertex at a place
};

/// Each reads a whole file; `name` is what errors call it. Errors (bad_input): what is not of the
/// format, with its line or the number of its vertex or triangle.
Result<SurfaceData> read_obj(std::string_view bytes, const std::string& name);
Result<SurfaceData> read_ply(std::string_view bytes, const std::string& name);
Result<SurfaceData> read_stl(std::string_view bytes, const std::string& name);

}  // namespace gridshell::preset
