#include "engine/formats/table_cells.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <utility>

#include "engine/formats/plain_text.h"
#include "engine/formats/point_file.h"

namespace gridshell::preset {

namespace {

bool is_unit(std::string_view word) {
  static constexpr std::array<std::string_view, 8> others{"n",       "kn",  "deg", "degree",
                                                          "degrees", "rad", "-",   "\xC2\xB0"};
  return millimetres_of(word) > 0 || std::ranges::find(others, word) != others.end();
}

}  // namespace

std::size_t remark_at(std::string_view line) {
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"') quoted = !quoted;
    if (!quoted && (line[k] == '#' || line.substr(k, 2) == "//")) return k;
  }
  return line.size();
}

void split(std::string_view line, char apart, Cells& cells) {
  cells.clear();
  line = trimmed(line);
  while (!line.empty() || (apart != ' ' && !cells.empty())) {
    bool quoted = false;
    std::size_t end = 0;
    for (; end < line.size(); ++end) {
      if (line[end] == '"') quoted = !quoted;
      const bool blank = word_blanks.find(line[end]) != word_blanks.npos;
      if (!quoted && (apart == ' ' ? blank : line[end] == apart)) break;
    }
    std::string_view cell = trimmed(line.substr(0, end));
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
      cell = trimmed(cell.substr(1, cell.size() - 2));
    // in "x, y" the blank separates the cells, and the comma is ignored
    if (apart == ' ' && cell.size() > 1 && (cell.back() == ',' || cell.back() == ';'))
      cell.remove_suffix(1);
    cells.push_back(cell);
    if (end == line.size()) break;
    line.remove_prefix(end + 1);
    if (apart == ' ') line = trimmed(line);
  }
  // spreadsheets fill rows with empty cells
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
}

bool is_missing(std::string_view cell) {
  static constexpr std::array<std::string_view, 6> marks{"", "nan", "-nan", "na", "n/a", "null"};
  return std::ranges::find(marks, lower(cell)) != marks.end();
}

bool has_decimal_comma(std::string_view cell) {
  const std::size_t comma = cell.find(',');
  const auto digit = [&](std::size_t k) {
    return k < cell.size() && std::isdigit((unsigned char)cell[k]) != 0;
  };
  return comma != cell.npos && comma > 0 && digit(comma - 1) && digit(comma + 1) &&
         cell.find_first_of(",.", comma + 1) == cell.npos && cell.find('.') == cell.npos;
}

std::optional<double> decimal_number(std::string_view cell) {
  if (!has_decimal_comma(cell)) return number_of(cell);
  std::string pointed(cell);
  pointed[pointed.find(',')] = '.';
  return number_of(pointed);
}

bool is_whole(std::string_view cell) {
  const auto value = number_of(cell);
  return value && cell.find_first_of(".eE,") == cell.npos;
}

ColumnName column_name(std::string_view cell) {
  ColumnName name;
  std::string text = lower(cell);
  for (const auto& [open, close] :
       {std::pair('[', ']'), {'(', ')'}, {'/', '\0'}, {'_', '\0'}, {' ', '\0'}}) {
    const std::size_t at = text.rfind(open);
    if (at == text.npos || at == 0) continue;
    std::string_view inside = std::string_view(text).substr(at + 1);
    if (close != '\0' && inside.ends_with(close)) inside.remove_suffix(1);
    // a text in brackets is a unit, known or not
    if (close == '\0' && !is_unit(trimmed(inside))) continue;
    name.unit = trimmed(inside);
    text.resize(at);
    break;
  }
  for (const char c : text)
    if (std::isalnum((unsigned char)c) || (unsigned char)c >= 0x80) name.base += c;
  static const std::map<std::string, std::string> others{
      {"easting", "x"}, {"east", "x"},      {"northing", "y"}, {"north", "y"},   {"height", "z"},
      {"elev", "z"},    {"elevation", "z"}, {"points0", "x"},  {"points1", "y"}, {"points2", "z"}};
  if (const auto found = others.find(name.base); found != others.end()) name.base = found->second;
  return name;
}

bool is_length(const std::string& name) {
  return name.ends_with("_mm") || name == "x" || name == "y" || name == "z" || name == "r";
}

bool is_name(std::string_view cell) {
  const auto c = cell.empty() ? ' ' : (unsigned char)cell.front();
  return (std::isalpha(c) || c == '_' || c >= 0x80) && !number_of(cell) && !is_missing(cell);
}

}  // namespace gridshell::preset
