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

}  // namespace gridshell::preset
