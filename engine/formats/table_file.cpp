#include "engine/formats/table_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/plain_text.h"
#include "engine/formats/point_file.h"
#include "engine/formats/table_cells.h"

namespace gridshell::preset {
namespace {

class TableReader {
 public:
  TableReader(const std::string& name, const std::vector<TableColumn>& columns,
              const TableOptions& options)
      : name_(name), requested_(columns), options_(options), scale_(columns.size(), 1) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      cell_index_.push_back(k);
      if (is_length(columns[k].name)) scale_[k] = options.unit_mm;
    }
    table_.columns = columns.size();
  }

  Result<NumberTable> read(std::string_view text) {
    find_separator(text);
    for (int line = 1; !text.empty(); ++line) TRY_DO(take(next_line(text), line));
    if (counted_) TRY_DO(check_count());
    if (table_.rows() == 0)
      return invalid("{}: got no point, expected one per line, {}", name_, columns_text());
    if (table_.rows() > 2 && numbered_ && length_ > requested_.size() && !table_.by_name)
      return invalid(
          "{}:{}: the first column counts the rows: which columns are {}? Expected a first line "
          "that names them",
          name_, table_.lines.front(), names_text());
    table_.scale = scale_;
    return std::move(table_);
  }

 private:
  std::string location(int line) const { return fmt::format("{}:{}", name_, line); }
  std::string names_text() const {
    std::vector<std::string> names;
    for (const TableColumn& one : requested_) names.push_back(one.name);
    return fmt::format("{}", fmt::join(names, ", "));
  }
  std::string columns_text() const {
    const bool words =
        std::ranges::any_of(requested_, [](const TableColumn& one) { return !one.words.empty(); });
    return fmt::format("{} {}: {}", requested_.size(), words ? "values" : "numbers", names_text());
  }

  static std::string_view without_remark(std::string_view line) {
    line = trimmed(line.substr(0, remark_at(line)));
    return line.starts_with('%') || line.starts_with('!') ? std::string_view() : line;
  }

  /// Finds the separator of most lines, from the first lines.
  void find_separator(std::string_view text) {
    constexpr std::size_t looked_at = 100;
    std::vector<std::string_view> lines;
    while (!text.empty() && lines.size() < looked_at) {
      const auto line = without_remark(next_line(text));
      if (!line.empty() && !(lines.empty() && is_whole(line))) lines.push_back(line);
    }
    const auto all = [&](auto&& condition) {
      return !lines.empty() && std::ranges::all_of(lines, condition);
    };
    Cells cells;
    // half of the lines is enough: a title or a truncated row may have other signs
    const auto parts = [&](char apart) {
      const auto split_up = [&](std::string_view line) {
        split(line, apart, cells);
        return cells.size() != 1;
      };
      return 2 * std::ranges::count_if(lines, split_up) >= std::ptrdiff_t(lines.size()) &&
             !lines.empty();
    };
    const auto number_with_blank = [&](std::string_view line) {
      split(line, '\t', cells);
      return std::ranges::any_of(cells, [](std::string_view cell) {
        return !cell.empty() && !is_name(cell) && cell.find(' ') != cell.npos;
      });
    };
    const auto decimal_commas = [&](std::string_view line) {
      split(line, ' ', cells);
      const bool names = std::ranges::all_of(cells, is_name);
      return cells.size() >= requested_.size() &&
             (names || std::ranges::all_of(cells, [](std::string_view cell) {
                return cell.find(',') == cell.npos || has_decimal_comma(cell);
              }));
    };
    if (!lines.empty() && lower(lines[0]).starts_with("sep=") && lines[0].size() == 5)
      apart_ = lines[0][4];
    else if (parts(';'))
      apart_ = ';';
    else if (parts('\t') && std::ranges::none_of(lines, number_with_blank))
      apart_ = '\t';
    else if (parts(',') && !all(decimal_commas))
      apart_ = ',';
    const auto has_commas = [&](std::string_view line) {
      split(line, apart_, cells);
      return std::ranges::any_of(cells, has_decimal_comma);
    };
    mixed_ = apart_ == ',' || std::ranges::none_of(lines, has_commas);
  }

  Result<void> take(std::string_view line, int number) {
    if (const auto remark = trimmed(line); remark.empty() || without_remark(line).empty()) {
      if (table_.rows() == 0 && !remark.empty()) remark_ = line;
      return {};
    }
    // Excel's line "sep=;" names the separator
    if (first_ && lower(trimmed(line)).starts_with("sep=")) return {};
    row_ = without_remark(line);
    split(row_, apart_, cells_);
    // a line of separators alone
    if (cells_.empty()) return {};
    if (cells_.size() == 1 && requested_.size() > 1 && is_whole(cells_[0]) && counts_here())
      return take_count(number);
    if (std::exchange(first_, false)) {
      const bool names = std::ranges::all_of(
          cells_, [](std::string_view cell) { return is_name(cell) || cell.empty(); });
      // a line of allowed values ("u", "begin") is a row, although these look like names
      const auto word = [&](std::string_view cell) { return is_word(cell); };
      if (names && !std::ranges::all_of(cells_, word)) return take_header(cells_, number);
      take_remark();
    }
    return take_row(number);
  }

  bool is_word(std::string_view cell) const {
    return std::ranges::any_of(requested_, [&](const TableColumn& one) {
      return std::ranges::find(one.words, cell) != one.words.end();
    });
  }

  /// Whether a line of one number may be a count of rows: before all rows, or after the rows of the
  /// last count.
  bool counts_here() const {
    const std::size_t rows = table_.rows() + table_.empty_rows;
    return (rows == counted_from_ && !table_.by_name) || (counted_ && rows == expected_);
  }

  Result<void> take_count(int number) {
    if (counted_ && table_.rows() + table_.empty_rows == counted_from_)
      return invalid(
          "{}: a second count of points: a scanner's grid (.ptx)? Expected points, one a line "
          "(.pts, .xyz, .ply)",
          location(number));
    const double count = *number_of(cells_[0]);
    if (!(count >= 1 && count <= 1e9))
      return invalid("{}: got a count of {} points, expected 1 to 1e9", location(number),
                     cells_[0]);
    counted_ = true;
    counted_from_ = table_.rows() + table_.empty_rows;
    expected_ = counted_from_ + std::size_t(count);
    return {};
  }

  Result<void> check_count() const {
    const std::size_t rows = table_.rows() + table_.empty_rows;
    if (rows == expected_) return {};
    return invalid("{0}: got {2} points, expected {1} by its first line: is the file cut short?",
                   name_, expected_, rows);
  }

  /// Uses a remark as the header if it names all columns of the first row.
  void take_remark() {
    std::string_view names = trimmed(remark_);
    names = trimmed(names.substr(std::min(names.find_first_not_of("#/%!"), names.size())));
    Cells cells;
    split(names, apart_ == ' ' && names.find(',') != names.npos ? ',' : apart_, cells);
    if (cells.size() != cells_.size()) split(names, ' ', cells);
    if (cells.size() != cells_.size() || !std::ranges::all_of(cells, is_name)) return;
    const auto before = std::pair(cell_index_, scale_);
    if (!take_header(cells, 0)) std::tie(cell_index_, scale_) = before;
  }

  Result<void> take_header(const Cells& cells, int line) {
    std::vector<std::string> missing;
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < requested_.size(); ++k) {
      const ColumnName requested = column_name(requested_[k].name);
      std::optional<std::size_t> at;
      for (std::size_t c = 0; c < cells.size(); ++c) {
        const ColumnName named = column_name(cells[c]);
        if (named.base != requested.base) continue;
        if (at) return invalid("{}: got column {} twice", location(line), requested_[k].name);
        at = c;
        TRY_DO(take_unit(k, named, requested, line));
      }
      if (at)
        found.push_back(*at);
      else
        missing.push_back(requested_[k].name);
    }
    if (!missing.empty())
      return invalid("{}: got columns '{}', of which {} {} missing (a remark begins with #)",
                     location(line), shortened(fmt::format("{}", fmt::join(cells, "', '"))),
                     fmt::join(missing, ", "), missing.size() > 1 ? "are" : "is");
    cell_index_ = found;
    length_ = cells.size();
    table_.by_name = true;
    return {};
  }

  static std::string shortened(std::string text) {
    constexpr std::size_t longest = 80;
    if (text.size() > longest) text.replace(longest, std::string::npos, "...");
    return text;
  }

  /// Sets the factor of a column from its unit.
  Result<void> take_unit(std::size_t column, const ColumnName& named, const ColumnName& requested,
                         int line) {
    const double mm = millimetres_of(named.unit);
    const bool length = is_length(requested_[column].name);
    if (length && mm > 0) scale_[column] = mm;
    const bool angle = requested.unit == "deg" && named.unit.starts_with("deg");
    const bool plain = named.unit.empty() || named.unit == requested.unit || named.unit == "-" ||
                       (!length && (named.unit == "n" || named.unit == "deg"));
    if ((length && mm > 0) || angle || plain) return {};
    return invalid("{}: column {}: got '{}', expected {}", location(line), requested_[column].name,
                   named.unit,
                   length                   ? "mm, cm, m, in or ft"
                   : requested.unit.empty() ? "the unit of its key"
                                            : requested.unit);
  }

  Result<void> take_row(int line) {
    const bool by_position = !table_.by_name;
    const std::size_t least = requested_.size();
    if (options_.empty_rows && is_empty_row()) {
      ++table_.empty_rows;
      return {};
    }
    fill_up();
    if (length_ == 0)
      length_ = by_position && !options_.longer_rows ? least : std::max(least, cells_.size());
    if (cells_.size() != length_ && !split_by_any()) return wrong_length(line);
    if (by_position && looks_like_commas())
      return invalid(
          "{}: six whole numbers between commas: decimal commas, or further columns? Expected a "
          "first line that names the columns, or semicolons part them",
          location(line));
    for (std::size_t k = 0; k < requested_.size(); ++k) {
      TRY(value, value_in(cells_[cell_index_[k]], k, line));
      table_.values.push_back(*value * scale_[k]);
    }
    table_.lines.push_back(line);
    numbered_ = numbered_ && table_.values[(table_.rows() - 1) * table_.columns] ==
                                 double(table_.rows()) * scale_[0];
    return {};
  }

  /// Whether every requested cell, or every cell of the row, is a missing number.
  bool is_empty_row() const {
    return std::ranges::all_of(cells_, is_missing) ||
           std::ranges::all_of(cell_index_, [&](std::size_t at) {
             return at < cells_.size() && is_missing(cells_[at]);
           });
  }

  /// Restores empty cells at the end of a row under a header: its last numbers may be unknown.
  void fill_up() {
    if (!table_.by_name || apart_ == ' ') return;
    const auto cells = std::size_t(std::ranges::count(row_, apart_)) + 1;
    if (cells == length_) cells_.resize(std::max(cells_.size(), cells));
  }

  /// Splits a row of numbers at any separator, if it has other ones than most rows and no comma is
  /// a decimal one. Returns whether that gave the right number of cells.
  bool split_by_any() {
    const Cells cells = words_in(row_, " \t\r\f\v,;");
    const bool numbers = std::ranges::all_of(
        cells, [](std::string_view cell) { return number_of(cell).has_value(); });
    if (!mixed_ || cells_.size() > length_ || cells.size() != length_ || !numbers) return false;
    cells_ = cells;
    return true;
  }

  /// Whether six integers are ambiguous: x, y, z with decimal commas, or x, y, z and a colour.
  bool looks_like_commas() const {
    return apart_ == ',' && requested_.size() == 3 && cells_.size() == 6 &&
           std::ranges::all_of(cells_, is_whole);
  }

  Result<void> wrong_length(int line) const {
    const bool commas = apart_ == ',' && cells_.size() > length_ &&
                        std::ranges::all_of(words_in(row_, " \t\r\f\v,"), is_whole);
    const std::string expected = table_.by_name ? fmt::format("{}, as the header names", length_)
                                 : length_ > requested_.size()
                                     ? fmt::format("{}, as in the rows before", length_)
                                     : columns_text();
    return invalid("{}: got {} values, expected {}{}", location(line), cells_.size(), expected,
                   commas ? "; with decimal commas, semicolons separate the columns" : "");
  }

  Result<double> value_in(std::string_view cell, std::size_t column, int line) {
    const auto& words = requested_[column].words;
    if (!words.empty()) {
      const auto found = std::ranges::find(words, cell);
      if (found != words.end()) return double(found - words.begin());
      return invalid("{}: got '{}', which is no value of its column, expected {}", location(line),
                     shortened(std::string(cell)), columns_text());
    }
    const auto value =
        apart_ == ',' && cell.find(',') == cell.npos ? number_of(cell) : decimal_number(cell);
    if (!value) {
      const bool blank = cell.find(' ') != cell.npos;
      const auto got = fmt::format("'{}'", shortened(std::string(cell)));
      return invalid("{}: got {}, which is no number, expected {}{}", location(line),
                     cell.empty() ? std::string("an empty cell") : got, columns_text(),
                     blank ? "; expected one sign between all cells" : "");
    }
    const bool comma = cell.find(',') != cell.npos, point = cell.find('.') != cell.npos;
    commas_ = commas_ || comma;
    points_ = points_ || point;
    if (commas_ && points_)
      return invalid("{}: '{}' after numbers with decimal {}, expected one decimal sign",
                     location(line), cell, comma ? "points" : "commas");
    return *value;
  }

  const std::string& name_;
  const std::vector<TableColumn>& requested_;
  const TableOptions& options_;
  char apart_ = ' ';
  Cells cells_;
  std::vector<std::size_t> cell_index_;  // index of each requested column among the cells
  std::vector<double> scale_;
  std::size_t length_ = 0;  // number of cells of a row
  std::string_view remark_, row_;
  bool mixed_ = false;  // no decimal comma was seen
  bool first_ = true, commas_ = false, points_ = false, numbered_ = true, counted_ = false;
  std::size_t expected_ = 0, counted_from_ = 0;  // rows after the counted ones, and before them
  NumberTable table_;
};

}  // namespace

Result<NumberTable> read_table(std::string_view bytes, const std::string& name,
                               const std::vector<TableColumn>& columns,
                               const TableOptions& options) {
  std::string storage;
  return TableReader(name, columns, options).read(plain_text(bytes, storage));
}

}  // namespace gridshell::preset
