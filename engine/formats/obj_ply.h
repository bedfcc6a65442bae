// Wavefront OBJ: lines "v x y z" and elements "f a b c ..." or "l a b ...".
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

/// What takes the lines of a .obj file; `place` begins every error: "dome.obj:17".
struct ObjCallbacks {
  std::function<Result<void>(const std::vector<double>& xyz, const std::string& place)> vertex;
  /// its vertices as the file counts them, from 0; whether they are there is not looked at
  std::function<Result<void>(const std::vector<long>& vertices, const std::string& place)> element;
};

/// Hands on the vertices of a file and its elements of one kind, "f" or "l". A line that ends in a
/// backslash continues on the next, what follows "#" is a remark; other lines are left out. Returns
/// how many elements of the other kind and points ("f", "l", "p") there are. Errors (bad_input): a
/// vertex that is not three finite numbers, an element with a text that is no number of a vertex
/// ("7", "7/1/2", or "-1" from the last), a free-form curve or surface, what `lines` says.
Result<std::map<std::string, int>> read_obj_lines(std::string_view bytes, const std::string& name,
                                                  std::string_view element,
                                                  const ObjCallbacks& lines);

// Geomview OFF: "OFF", the numbers of vertices, faces and edges, then one of these per line.

/// Passes on the vertices of a file and its faces; text after "#" is a remark, text after a face's
/// vertices its colour. Errors (bad_input): no numbers of vertices and faces at its start, fewer
/// lines than these say, an invalid line, errors of `lines`.
Result<void> read_off_lines(std::string_view bytes, const std::string& name,
                            const ObjCallbacks& lines);

// Stanford PLY: elements with properties that its header names, as text or as bytes.

/// One element of a file: a vertex, a face, or of another kind.
struct PlyItem {
  std::string element;     ///< "vertex"
  std::size_t number = 0;  ///< from 0
  /// its properties x, y, z; NaN: it has none
  Eigen::Vector3d xyz = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  bool has_xyz = false;       ///< its element has all three
  std::vector<long> corners;  ///< its list vertex_indices; of an edge vertex1 and vertex2

  /// "dome.ply: vertex 3"
  std::string place(const std::string& name) const;
};

/// Calls `take` for every element of a complete file, in order; `name` is its name in messages.
/// Errors (bad_input): text that is not of the format, with its line or the number of its element;
/// those of `take`, which end the reading.
Result<void> each_ply_item(std::string_view bytes, const std::string& name,
                           const std::function<Result<void>(const PlyItem&)>& take);

}  // namespace gridshell::preset
