#include "engine/formats/csv.h"

#include <fmt/format.h>

#include <cmath>

namespace gridshell::record {

void CsvWriter::cell(int value) { start() += fmt::format("{}", value); }

void CsvWriter::cell(double value) {
  std::string& text = start();
  if (!std::isnan(value)) text += fmt::format("{}", value);
}

void CsvWriter::cell(std::string_view value) {
  std::string& text = start();
  if (value.find_first_of(",\"\r\n") == std::string::npos) {
    text += value;
    return;
  }
  text += '"';
  for (const char c : value) text.append(c == '"' ? 2 : 1, c);
  text += '"';
}

std::string& CsvWriter::start() {
  if (!first_) text_ += ',';
  first_ = false;
  return text_;
}

std::vector<std::vector<std::string>> csv_cells(std::string_view text) {
  std::vector<std::vector<std::string>> rows;
  bool quoted = false, line_begins = true;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (std::exchange(line_begins, false)) rows.emplace_back(1);
    std::string& cell = rows.back().back();
    if (quoted && c == '"' && k + 1 < text.size() && text[k + 1] == '"')
      cell += text[++k];
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && c == ',')
      rows.back().emplace_back();
    else if (!quoted && c == '\n')
      line_begins = true;
    else if (quoted || c != '\r')
      cell += c;
  }
  return rows;
}

}  // namespace gridshell::record
