#include "engine/preset/point_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "engine/core/atomic_file.h"
#include "engine/core/number.h"

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

// a number, or the place of a word where a coordinate has words
std::optional<double> value_of(const std::string& word, std::size_t coordinate,
                               const std::vector<std::vector<std::string>>& words) {
  if (coordinate >= words.size() || words[coordinate].empty()) return number_of(word);
  const auto& allowed = words[coordinate];
  const auto found = std::find(allowed.begin(), allowed.end(), word);
  if (found == allowed.end()) return std::nullopt;
  return double(found - allowed.begin());
}

}  // namespace

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto value = number_from<double>(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::string ending_of(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  for (char& c : ending) c = char(std::tolower((unsigned char)c));
  return ending;
}

Result<Points> read_points(const std::filesystem::path& file,
                           const std::vector<std::string>& coordinates,
                           const std::vector<std::vector<std::string>>& known) {
  const auto text = read_whole(file, largest_text);
  if (!text) return fail(Fault::bad_input, text.error().message);
  return points_in(*text, file.string(), coordinates, known);
}

Result<Points> points_in(const std::string& text, const std::string& name,
                         const std::vector<std::string>& coordinates,
                         const std::vector<std::vector<std::string>>& known,
                         std::vector<int>* lines_of) {
  const auto wanted =
      fmt::format("{} {}: {}", coordinates.size(), known.empty() ? "numbers" : "values",
                  fmt::join(coordinates, ", "));
  Points points;
  std::istringstream lines(text);
  std::string line;
  bool header = true;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto words = words_of(line);
    if (words.empty()) continue;
    const bool first = std::exchange(header, false);
    // a CSV file names its columns first
    if (first && !value_of(words.front(), 0, known)) continue;
    const auto place = fmt::format("{}:{}", name, number);
    if (words.size() != coordinates.size())
      return fail(Fault::bad_input,
                  fmt::format("{}: holds {} values, must be {}", place, words.size(), wanted));
    points.emplace_back();
    if (lines_of) lines_of->push_back(number);
    for (const auto& word : words) {
      const auto value = value_of(word, points.back().size(), known);
      if (!value)
        return fail(Fault::bad_input,
                    fmt::format("{}: '{}' is no {}, must be {}", place, word,
                                known.empty() ? "number" : "value of its column", wanted));
      points.back().push_back(*value);
    }
  }
  if (points.empty())
    return fail(Fault::bad_input,
                fmt::format("{}: holds no point, must hold one a line, {}", name, wanted));
  return points;
}

}  // namespace gridshell::preset
