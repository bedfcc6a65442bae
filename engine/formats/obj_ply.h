// Readers of vertices and elements in Wavefront OBJ, Geomview OFF and Stanford PLY files.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gridshell::preset {

/// Receivers of the vertices and elements of a file; errors start with `where`: "dome.obj:17".
struct ObjCallbacks {
  std::function<Result<void>(const std::vector<double>& xyz, const std::string& where)> vertex;
  /// `vertices` are indices from 0; they are not checked.
  std::function<Result<void>(const std::vector<long>& vertices, const std::string& where)> element;
};

/// Reads an OBJ file: vertices "v x y z" and the elements of one kind, faces "f a b c ..." or
/// polylines "l a b ...". A line that ends in a backslash continues on the next one, text after "#"
/// is a comment, other lines are ignored. Returns the numbers of elements of the other kinds ("f",
/// "l", "p"). Errors (bad_input): a vertex that is not three finite numbers, an element with a text
/// that is no index of a vertex ("7", "7/1/2", or "-1" for the last), a free-form curve or surface;
/// errors of `lines`.
Result<std::map<std::string, int>> read_obj_lines(std::string_view bytes, const std::string& name,
                                                  std::string_view element,
                                                  const ObjCallbacks& lines);

/// Reads an OFF file: "OFF", the numbers of vertices, faces and edges, then one vertex or face per
/// line. Text after "#" is a comment, text after a face's vertices its colour. Errors (bad_input):
/// no numbers of vertices and faces at its start, fewer lines than these numbers, an invalid line;
/// errors of `lines`.
Result<void> read_off_lines(std::string_view bytes, const std::string& name,
                            const ObjCallbacks& lines);

/// One element of a PLY file: a vertex, a face, an edge, or of another kind.
struct PlyItem {
  std::string element;     ///< "vertex"
  std::size_t number = 0;  ///< its number among the elements of its kind, from 0
  /// Its properties x, y, z; NaN if it has none.
  Eigen::Vector3d xyz = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  bool has_xyz = false;       ///< whether it has all three
  std::vector<long> corners;  ///< its list vertex_indices; for an edge vertex1 and vertex2

  /// Its position for messages: "dome.ply: vertex 3".
  std::string location(const std::string& name) const;
};

/// Reads a PLY file, text or binary: calls `take` for every element, in order. `name` is the file's
/// name in messages. Errors (bad_input): text that is not of the format, with its line or the
/// number of its element; errors of `take`, which end the reading.
Result<void> each_ply_item(std::string_view bytes, const std::string& name,
                           const std::function<Result<void>(const PlyItem&)>& take);

}  // namespace gridshell::preset
