// Points as a preset lists them.
#pragma once

#include <array>
#include <vector>

namespace gridshell::preset {

/// Points of a curve, each of as many coordinates as its key says, mm.
using Points = std::vector<std::vector<double>>;

/// A surface that a file gives, mm: heights over a rectangular grid, or triangles.
struct SurfaceData {
  std::vector<double> x, y;                   ///< of a grid, rising
  Points z;                                   ///< its heights, a row for every y
  Points vertices;                            ///< x, y, z
  std::vector<std::array<int, 3>> triangles;  ///< numbers of their vertices

  bool is_mesh() const { return !triangles.empty(); }
  bool empty() const { return z.empty() && triangles.empty(); }
};

/// A network of rods that a file gives. Points have one place each: rods that name the same
/// point are joined there.
struct NetworkData {
  Points points;                       ///< x, y, z, mm
  std::vector<std::vector<int>> rods;  ///< each the numbers of its points in order
  std::vector<double> diameters;       ///< one a rod, mm, 0: that of [rod]; empty: all that
  Points supports;                     ///< number of a point and where it goes: x, y, z, mm
  Points springs;         ///< number of a support's point, stiffness along x, y, z, N/mm
  std::vector<int> free;  ///< numbers of points at rods' ends that nothing holds

  bool empty() const { return rods.empty(); }
};

}  // namespace gridshell::preset
