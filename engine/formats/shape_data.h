// Points as a preset lists them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "engine/core/fields.h"

namespace gridshell::preset {

/// Points of a curve, each of as many coordinates as its key says, mm.
using Points = std::vector<std::vector<double>>;

/// The first `rows` coordinates of points, as columns.
template <int rows>
Eigen::Matrix<double, rows, Eigen::Dynamic> matrix_of(const Points& points) {
  Eigen::Matrix<double, rows, Eigen::Dynamic> matrix(rows, points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    for (int row = 0; row < rows; ++row)
      matrix(row, Eigen::Index(k)) = points[k].at(std::size_t(row));
  return matrix;
}

/// What came of a file.
struct FileReport {
  std::string text;                ///< one sentence: its contents, its size, its unit
  std::vector<std::string> notes;  ///< what may not be as it was meant
};

/// A surface that a file gives, mm: heights over a rectangular grid, or triangles.
struct SurfaceData {
  std::vector<double> x, y;                   ///< of a grid, rising
  Points z;                                   ///< its heights, a row for every y
  Points vertices;                            ///< x, y, z
  std::vector<std::array<int, 3>> triangles;  ///< numbers of their vertices

  bool is_mesh() const { return !triangles.empty(); }
  bool empty() const { return z.empty() && triangles.empty(); }
};

/// Replaces a joint's point in a row of joint_laws: the row is of all joints without one.
inline constexpr double every_joint = -1;

/// End condition of a rod: prescribed position; direction too; twist angle too.
enum class EndKind { pinned, tangent, clamped };

/// What a network's rod has of its own: a key of [rod] and its number, true: 1, false: 0.
struct RodValue {
  int rod = 0;
  std::string key;
  double value = 0;
};

/// A network of rods from a file. Each point is stored once: rods with a common point are joined
/// there.
struct NetworkData {
  Points points;                       ///< x, y, z, mm
  std::vector<std::vector<int>> rods;  ///< each the numbers of its points in order
  std::vector<double> diameters;       ///< one per rod, mm, 0: that of [rod]; empty: all that
  std::vector<RodValue> own;           ///< else of single rods, in the order of these
  Points supports;                     ///< number of a point and where it goes: x, y, z, mm
  Points springs;         ///< number of a support's point, stiffness along x, y, z, N/mm
  std::vector<int> free;  ///< indices of points at free ends of rods
  /// A joint's point (every_joint: all without a row), its shear_Nmm and twist_Nmm (below 0:
  /// rigid), and its eccentricity_mm, if it differs from the preset's.
  Points joint_laws;
  Points holds;  ///< a rod, 0 (its start) or 1 (its end), the number of an EndKind

  bool empty() const { return rods.empty(); }
};

/// Whether an end of a rod is clamped.
inline bool clamps(const NetworkData& network) {
  return std::ranges::any_of(network.holds,
                             [](const auto& row) { return row[2] == double(EndKind::clamped); });
}

/// Whether a rod is closed: its last point is its first.
inline bool has_closed_rods(const NetworkData& network) {
  return std::ranges::any_of(
      network.rods, [](const auto& rod) { return rod.size() > 2 && rod.front() == rod.back(); });
}

// Both as tables of a preset: visit(key, member, whether it must be there).

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
  visit("holds", data.holds, false);
}

}  // namespace gridshell::preset
