// CSV text (RFC 4180). Numbers have the fewest digits that read back bit for bit.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/enum_words.h"

namespace gridshell::record {

/// Writes a CSV file (RFC 4180, "\n" at the end of a line), cell by cell.
class CsvWriter {
 public:
  void cell(const char* text) { cell(std::string(text)); }
  /// A bool is written as 0 or 1.
  void cell(int value);
  /// NaN gives an empty cell.
  void cell(double value);
  void cell(std::string_view value);
  /// An object with a function text().
  template <class Name>
  requires requires(const Name& name) { name.text(); }
  void cell(const Name& name) { cell(std::string_view(name.text())); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void cell(Enum value) { cell(word_of(value)); }
  void end_line() {
    text_ += '\n';
    first_ = true;
  }
  template <class... Cells>
  void line(const Cells&... cells) {
    (cell(cells), ...);
    end_line();
  }
  /// A line with the names of a row's members, as `fields` (core/fields.h) lists them.
  template <class Row>
  void names_of(const Row& row) {
    fields(row, [&](const char* name, const auto&) { cell(name); });
    end_line();
  }
  /// A line with the values of a row's members.
  template <class Row>
  void members_of(const Row& row) {
    fields(row, [&](const char*, const auto& value) { cell(value); });
    end_line();
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string& start();
  std::string text_;
  bool first_ = true;
};

/// The cells of a text of RFC 4180: one list per line.
std::vector<std::vector<std::string>> csv_cells(std::string_view text);

/// The text of a table whose columns `fields` lists; an unknown number is an empty cell.
template <class Row>
std::string csv_table(const std::vector<Row>& rows) {
  CsvWriter csv;
  csv.names_of(Row());
  for (const Row& row : rows) csv.members_of(row);
  return std::move(csv).text();
}

}  // namespace gridshell::record
