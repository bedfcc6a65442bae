// Data of shapes that a preset contains or names in files: points, surfaces, networks of rods.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "engine/core/fields.h"

namespace gridshell::preset {

/// A table of points: one row per point, each with the coordinates that its key defines, mm.
using Points = std::vector<std::vector<double>>;

/// The first `rows` coordinates of each point as a column.
template <int rows>
Eigen::Matrix<double, rows, Eigen::Dynamic> matrix_of(const Points& points) {
  Eigen::Matrix<double, rows, Eigen::Dynamic> matrix(rows, points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    for (int row = 0; row < rows; ++row)
      matrix(row, Eigen::Index(k)) = points[k].at(std::size_t(row));
  return matrix;
}

/// Report on a file that was read.
struct FileReport {
  std::string text;                ///< one sentence on its contents, size and unit
  std::vector<std::string> notes;  ///< sentences on what is probably a mistake
};

/// A surface, mm: heights over a rectangular grid, or triangles.
struct SurfaceData {
  std::vector<double> x, y;                   ///< coordinates of the grid, rising
  Points z;                                   ///< heights over the grid, one row per y
  Points vertices;                            ///< vertices of the triangles: x, y, z
  std::vector<std::array<int, 3>> triangles;  ///< indices of their vertices

  bool is_mesh() const { return !triangles.empty(); }
  bool empty() const { return z.empty() && triangles.empty(); }
};

/// Value of a row of joint_laws instead of a point: the law of all joints without their own row.
inline constexpr double every_joint = -1;

/// End condition of a rod: position prescribed (pinned); direction, too (tangent); twist angle, too
/// (clamped).
enum class EndKind { pinned, tangent, clamped };

/// A key of [rod] that a single rod of a network has with another value; true: 1, false: 0.
struct RodValue {
  int rod = 0;
  std::string key;
  double value = 0;
};

/// A network of rods from a file. Each point is stored once: rods with a common point are joined
/// there.
struct NetworkData {
  Points points;                       ///< x, y, z, mm
  std::vector<std::vector<int>> rods;  ///< indices of the points of each rod, in order
  std::vector<double> diameters;       ///< diameter of each rod, mm, 0: that of [rod]; may be empty
  std::vector<RodValue> own;           ///< other keys of single rods, in the order of the rods
  /// Rows (point) or (point, x, y, z): a supported point, and its actuated position, mm.
  Points supports;
  /// Rows (point of a support, kx, ky, kz): a support on a spring, N/mm.
  Points springs;
  std::vector<int> free;  ///< indices of points at free ends of rods
  /// Rows (point, shear_Nmm, twist_Nmm) or (point, shear_Nmm, twist_Nmm, eccentricity_mm): the law
  /// of a joint, below 0: rigid; point every_joint: the law of all joints without a row.
  Points joint_laws;
  /// Rows (rod, 0 for its start or 1 for its end, index of an EndKind): constraints of single ends.
  Points end_constraints;

  bool empty() const { return rods.empty(); }
};

/// Whether an end of a rod is clamped.
inline bool clamps(const NetworkData& network) {
  return std::ranges::any_of(network.end_constraints,
                             [](const auto& row) { return row[2] == double(EndKind::clamped); });
}

/// Whether a rod is closed: its last point is its first.
inline bool has_closed_rods(const NetworkData& network) {
  return std::ranges::any_of(
      network.rods, [](const auto& rod) { return rod.size() > 2 && rod.front() == rod.back(); });
}

// Surfaces and networks as tables of a preset.

/// Calls visit(key, member, required) for each member of a grid, or, if `mesh`, of a mesh.
template <RecordOf<SurfaceData> Data, class Visit>
void each_part(Data& data, bool mesh, const Visit& visit) {
  if (mesh) {
    visit("vertices_mm", data.vertices, true);
    visit("triangles", data.triangles, true);
  } else {
    visit("x_mm", data.x, true);
    visit("y_mm", data.y, true);
    visit("z_mm", data.z, true);
  }
}

/// Calls visit(key, member, required) for each member of a network.
template <RecordOf<NetworkData> Data, class Visit>
void each_part(Data& data, bool, const Visit& visit) {
  visit("points_mm", data.points, true);
  visit("rods", data.rods, true);
  visit("diameters_mm", data.diameters, false);
  visit("own", data.own, false);
  visit("supports_mm", data.supports, false);
  visit("springs_N_per_mm", data.springs, false);
  visit("free", data.free, false);
  visit("joint_laws", data.joint_laws, false);
  visit("holds", data.end_constraints, false);
}

}  // namespace gridshell::preset
