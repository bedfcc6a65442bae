// Points in a text file: boundaries, profiles, curves and measured joints that a user brings.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/preset/preset.h"

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

}  // namespace gridshell::preset
