// Reads tables of numbers that spreadsheets, scanners and other programs write.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gridshell::preset {

/// A requested column.
struct TableColumn {
  std::string name;                     ///< "x", "F_x", "leg_mm"
  std::vector<std::string> words = {};  ///< allowed names, if its values are names; else empty
};

/// How a table is read.
struct TableOptions {
  bool longer_rows = false;  ///< without a header a row may be longer; further cells are ignored
  bool empty_rows = false;   ///< a row without any number (nan, empty cells) is left out
  double unit_mm = 1;        ///< unit of lengths whose column names none, mm
};

/// Rows with one number per requested column; a name is stored as its index.
struct NumberTable {
  std::size_t columns = 0;
  std::vector<double> values;  ///< row after row
  std::vector<double> scale;   ///< unit of each column, in which its numbers were given
  std::vector<int> lines;      ///< line of each row in the file
  std::size_t empty_rows = 0;  ///< number of rows left out
  bool by_name = false;        ///< whether the columns were found by a header

  std::size_t rows() const { return lines.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

/// Reads a table, one row per line:
///   - Cells are separated by semicolons, tabs, commas or blanks, and may be quoted. A row of
///     numbers may have another separator than most rows, if no comma is a decimal one.
///   - Numbers have decimal points, or decimal commas if no comma separates cells; a file has one
///     of the two.
///   - Text after "#" or "//", lines that start with "%" or "!", and empty lines are comments.
///   - A first line that contains only names is a header: columns are found by their names in any
///     order, without regard to case. A name may have a unit (x_mm, "X [m]"), in which lengths are
///     read. Other columns are ignored. The last comment before the rows is a header if it names
///     every column.
///   - A first line of one integer is the number of rows (.pts), which must be correct.
/// Errors (bad_input), as "name:line: ...": a header without a requested column, a row with another
/// number of cells, a cell that is no finite number or allowed name, another number of rows than
/// the first line gives, numbers that look like decimal commas between commas, no row.
Result<NumberTable> read_table(std::string_view bytes, const std::string& name,
                               const std::vector<TableColumn>& columns,
                               const TableOptions& options = {});

}  // namespace gridshell::preset
