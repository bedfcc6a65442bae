// Clouds of points in files of 3D scanners.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "engine/core/result.h"

namespace gridshell::preset {

/// The largest file of points that is read, and the most points.
inline constexpr std::size_t largest_cloud_file = std::size_t(512) << 20,
                             most_cloud_points = 10000000;

/// Reads points, 3 x n, mm, as the name's ending says: .ply (text or bytes; of the elements the
/// vertices), .xyz, .txt, .asc or .csv: a point a line, numbers apart by blanks, commas or
/// semicolons, the first three of them x, y, z, what follows (normals, colours) left out; a first
/// line of words names the columns, of which x, y, z (or x_mm, y_mm, z_mm) are then taken. A '#'
/// begins a remark. Errors (bad_input), with `name` and line or number: what is not of the format,
/// NaN, a coordinate above 1e9 mm, no point at all, too many.
Result<Eigen::Matrix3Xd> read_cloud(std::string_view bytes, const std::string& name);

}  // namespace gridshell::preset
