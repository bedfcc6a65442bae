// Points in a text file: boundaries, profiles, curves and measured joints that a user brings.
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

/// A finite number that is all of a word.
std::optional<double> number_of(std::string_view word);

/// ".csv" of "Points.CSV": what a file's name says of its format, in small letters.
std::string ending_of(const std::string& name);

/// Reads a point a line: as many numbers as there are `coordinates`, apart by blanks or commas.
/// What follows a '#' and empty lines are left out, and a first line of words (a CSV header) too.
/// A coordinate that has `words` is the place of one of them. Errors (bad_input) as "file:line:
/// what is wrong, must be ..."; a file that cannot be read, or holds no point.
Result<Points> read_points(const std::filesystem::path& file,
                           const std::vector<std::string>& coordinates,
                           const std::vector<std::vector<std::string>>& words = {});

/// The same of a text that errors call `name`; `lines`, where given, takes the line of each point.
Result<Points> points_in(const std::string& text, const std::string& name,
                         const std::vector<std::string>& coordinates,
                         const std::vector<std::vector<std::string>>& words = {},
                         std::vector<int>* lines = nullptr);

// Clouds of points in files of 3D scanners.

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
