// CSV text (RFC 4180), numbers as the shortest that read back bit for bit.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/enum_words.h"

namespace gridshell::record {

/// One CSV file as it grows (RFC 4180, "\n" at the end of a line).
class CsvWriter {
 public:
  void cell(const char* text) { cell(std::string(text)); }
  /// A bool is 0 or 1.
  void cell(int value);
  void cell(double value);
  void cell(std::string_view value);
  /// What has a text of its own.
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
  /// What `fields` (core/fields.h) says of a row: the names, or the members.
  template <class Row>
  void names_of(const Row& row) {
    fields(row, [&](const char* name, const auto&) { cell(name); });
    end_line();
  }
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

/// The cells of a text of RFC 4180, a row a line.
std::vector<std::vector<std::string>> csv_cells(std::string_view text);

/// The text of a table whose columns `fields` names; an unknown number is an empty cell.
template <class Row>
std::string csv_table(const std::vector<Row>& rows) {
  CsvWriter csv;
  csv.names_of(Row());
  for (const Row& row : rows) csv.members_of(row);
  return std::move(csv).text();
}

}  // namespace gridshell::record
