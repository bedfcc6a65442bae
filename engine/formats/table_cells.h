// The cells of a table's lines, and the names of its columns.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gridshell::preset {

using Cells = std::vector<std::string_view>;

/// Where the remark of a line begins ("#" or "//" outside of quotes); its length: there is none.
std::size_t remark_at(std::string_view line);

/// Splits a line into cells at `apart` (' ': any number of blanks), without blanks and quotes
/// around them, and without empty cells at its end.
void split(std::string_view line, char apart, Cells& cells);

/// Whether a cell says that there is no number: empty, "nan", "NA", "null".
bool is_missing(std::string_view cell);

/// Whether a cell has exactly one comma, between digits, and no point.
bool has_decimal_comma(std::string_view cell);

/// A finite number with a decimal point or comma.
std::optional<double> decimal_number(std::string_view cell);

/// Whether a cell is a number without a point, a comma or an exponent.
bool is_whole(std::string_view cell);

/// A column as a header names it: its letters and digits in small letters, and its unit: "x" and
/// "mm" of "X [mm]", "x_mm" and "X (mm)", "fx" and "" of "F_x".
struct ColumnName {
  std::string base, unit;
};
ColumnName column_name(std::string_view cell);

/// Whether a requested column of this name contains lengths.
bool is_length(const std::string& name);

/// Whether a cell begins as a name does, and is no number.
bool is_name(std::string_view cell);

}  // namespace gridshell::preset
