#include "engine/preset/point_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "engine/core/atomic_file.h"

namespace gridshell::preset {
namespace {

std::vector<std::string> words_of(std::string line) {
  line = line.substr(0, line.find('#'));
  for (char& c : line)
    if (c == ',' || c == ';' || c == '\t' || c == '\r') c = ' ';
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::optional<double> number_of(const std::string& word) {
  double value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

}  // namespace

Result<Points> read_points(const std::filesystem::path& file,
                           const std::vector<std::string>& coordinates) {
  const auto text = read_whole(file, largest_text);
  if (!text) return fail(Fault::bad_input, text.error().message);
  const auto wanted =
      fmt::format("{} numbers: {}", coordinates.size(), fmt::join(coordinates, ", "));
  Points points;
  std::istringstream lines(*text);
  std::string line;
  bool header = true;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto words = words_of(line);
    if (words.empty()) continue;
    const bool first = std::exchange(header, false);
    // a CSV file names its columns first
    if (first && !number_of(words.front())) continue;
    const auto place = fmt::format("{}:{}", file.string(), number);
    if (words.size() != coordinates.size())
      return fail(Fault::bad_input,
                  fmt::format("{}: holds {} values, must be {}", place, words.size(), wanted));
    points.emplace_back();
    for (const auto& word : words) {
      const auto value = number_of(word);
      if (!value)
        return fail(Fault::bad_input,
                    fmt::format("{}: '{}' is no number, must be {}", place, word, wanted));
      points.back().push_back(*value);
    }
  }
  if (points.empty())
    return fail(Fault::bad_input,
                fmt::format("{}: holds no point, must hold one a line, {}", file.string(), wanted));
  return points;
}

}  // namespace gridshell::preset
