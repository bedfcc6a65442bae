// Surfaces in files that a user brings: heights over a grid, meshes of triangles.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/preset/points.h"

namespace gridshell::preset {

/// The largest file of a mesh that is read.
inline constexpr std::size_t largest_mesh_file = std::size_t(64) << 20;

/// Reads a file as its name's ending says: .csv and .txt hold heights, a point x, y, z a line in
/// any order (as PointList), at all places of a rectangular grid of 4 x 4 or more; .obj, .ply and
/// .stl triangles, vertices at one place being one. Errors (bad_input), with `name` and the line or
/// the number of what is wrong: not of the format, NaN, a place of the grid without a point or with
/// two, more than 100 000 points or 200 000 triangles, another ending.
Result<SurfaceData> read_surface(std::string_view bytes, const std::string& name);

/// What is wrong with a surface that a preset holds itself; empty: nothing.
std::string surface_fault(const SurfaceData& surface);

}  // namespace gridshell::preset
