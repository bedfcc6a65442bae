// Points in files of users: boundaries, profiles, curves, measured joints, clouds of 3D scanners.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/formats/shape_data.h"

namespace gridshell::preset {

/// The number that a complete word is; empty: it is no finite number.
std::optional<double> number_of(std::string_view word);

/// The ending of a file's name in lower case: ".csv" of "Points.CSV".
std::string ending_of(const std::string& name);

/// Reads a table (table_file.h) with the columns `coordinates`; `name` is its name in messages. A
/// column with `words` contains names, which are returned as their indices. Errors (bad_input):
/// those of read_table().
Result<Points> points_in(std::string_view text, const std::string& name,
                         const std::vector<std::string>& coordinates,
                         const std::vector<std::vector<std::string>>& words = {});

// Clouds of points in files of 3D scanners.

/// Largest size of a file of points, in bytes, and largest number of points.
inline constexpr std::size_t largest_cloud_file = std::size_t(512) << 20,
                             most_cloud_points = 10000000;

/// A point cloud, and the number of rows of its file without a point (nan).
struct Cloud {
  Eigen::Matrix3Xd points;  ///< 3 x n, mm
  std::size_t empty_rows = 0;
};

/// Reads points in the format of the name's ending: .ply (the vertices, text or binary), or .xyz,
/// .txt, .asc, .csv or .pts: a table (table_file.h) of x, y, z; normals and colours may follow.
/// `unit_mm` is the unit of a file that names none. Errors (bad_input), with `name` and line or
/// number: text that is not of the format, a row in which some numbers are missing, a coordinate
/// above 1e9 mm, no point, too many points.
Result<Cloud> read_cloud(std::string_view bytes, const std::string& name, double unit_mm = 1);

}  // namespace gridshell::preset
