// The cells of a table's lines, and the names of its columns.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gridshell::preset {

using Cells = std::vector<std::string_view>;

/// Position at which the comment of a line starts ("#" or "//" outside quotes); without a comment
/// the length of the line.
std::size_t remark_at(std::string_view line);

/// Splits a line into cells at `apart` (' ': any number of blanks), without blanks and quotes
/// around them, and without empty cells at its end.
void split(std::string_view line, char apart, Cells& cells);

/// Whether a cell marks a missing number: empty, "nan", "NA", "null".
bool is_missing(std::string_view cell);

/// Whether a cell has exactly one comma, between digits, and no point.
bool has_decimal_comma(std::string_view cell);

/// A finite number with a decimal point or comma.
std::optional<double> decimal_number(std::string_view cell);

/// Whether a cell is a number without a point, a comma or an exponent.
bool is_whole(std::string_view cell);

/// The name of a column in a header: its letters and digits in lower case, and its unit. "X [mm]",
/// "x_mm" and "X (mm)" have base "x" and unit "mm"; "F_x" has base "fx" and no unit.
struct ColumnName {
  std::string base, unit;
};
/// The name and unit in a cell of a header.
ColumnName column_name(std::string_view cell);

/// Whether a requested column of this name contains lengths.
bool is_length(const std::string& name);

/// Whether a cell starts with a letter and is no number.
bool is_name(std::string_view cell);

}  // namespace gridshell::preset
