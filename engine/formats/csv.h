// CSV text (RFC 4180), numbers as the shortest that read back bit for bit.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>

namespace gridshell::record {

/// One CSV file as it grows (RFC 4180, "\n" at the end of a line).
class CsvWriter {
 public:
  void cell(const char* text) { cell(std::string(text)); }
  void cell(int value) { start() += fmt::format("{}", value); }
  void cell(double value) {
    std::string& text = start();
    if (!std::isnan(value)) text += fmt::format("{}", value);
  }
  void cell(std::string_view value) {
    std::string& text = start();
    if (value.find_first_of(",\"\r\n") == std::string::npos) {
      text += value;
      return;
    }
    text += '"';
    for (const char c : value) text.append(c == '"' ? 2 : 1, c);
    text += '"';
  }
  void end_line() {
    text_ += '\n';
    first_ = true;
  }
  template <class... Cells>
  void line(const Cells&... cells) {
    (cell(cells), ...);
    end_line();
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string& start() {
    if (!first_) text_ += ',';
    first_ = false;
    return text_;
  }
  std::string text_;
  bool first_ = true;
};

}  // namespace gridshell::record
