// Tables of numbers as spreadsheets, scanners and programs write them: one reader for all of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"

namespace gridshell::preset {

/// A column that is wanted.
struct TableColumn {
  std::string name;                     ///< "x", "F_x", "leg_mm"
  std::vector<std::string> words = {};  ///< where its values are texts: which there are
};

struct TableOptions {
  bool longer_rows = false;  ///< without a header a row may go on; what follows is left out
  bool empty_rows = false;   ///< a row without any number (nan, empty cells) is left out
  double unit_mm = 1;        ///< of lengths whose column names no unit
};

/// Rows of as many numbers as there were columns wanted; a text is the number of its word.
struct NumberTable {
  std::size_t columns = 0;
  std::vector<double> values;  ///< row after row
  std::vector<int> lines;      ///< of each row
  std::size_t empty_rows = 0;  ///< rows left out
  bool by_name = false;        ///< columns were found by a header

  std::size_t rows() const { return lines.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

/// Reads a table, a row a line:
///   cells apart by semicolons, tabs, commas or blanks, cells may be quoted; a row of numbers may
///   have another of them than most rows, where no comma is a decimal one; decimal points, or
///   decimal commas where no comma parts cells; a file has one of the two; what follows "#" or
///   "//", lines that begin with "%" or "!", and empty lines are remarks; a first line of names
///   alone is a header: columns are found by their names in any order, names in capitals or with a
///   unit (x_mm, "X [m]") being the same, lengths in that unit; the last remark before the rows is
///   one where it names every column; other columns are left out; a first line of one whole number
///   counts the rows (.pts), which must be there.
/// Errors (bad_input), as "name:line: ...": a header without a column that is wanted, a row of
/// another number of cells, a cell that is no finite number or none of its words, rows that are
/// fewer than their count; what looks like decimal commas between commas; no row.
Result<NumberTable> read_table(std::string_view bytes, const std::string& name,
                               const std::vector<TableColumn>& columns,
                               const TableOptions& options = {});

}  // namespace gridshell::preset
