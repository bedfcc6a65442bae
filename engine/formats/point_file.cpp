#include "engine/formats/point_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "engine/core/file_io.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/obj_ply.h"
#include "engine/formats/surface_file.h"

namespace gridshell::preset {
namespace {

/// What a line holds before its remark.
std::vector<std::string_view> values_in(std::string_view line) {
  return words_in(line.substr(0, line.find('#')), " \t\r\f\v,;");
}

// a number, or the place of a word where a coordinate has words
std::optional<double> value_of(std::string_view word, std::size_t coordinate,
                               const std::vector<std::vector<std::string>>& words) {
  if (coordinate >= words.size() || words[coordinate].empty()) return number_of(word);
  const auto& allowed = words[coordinate];
  const auto found = std::ranges::find(allowed, word);
  if (found == allowed.end()) return std::nullopt;
  return double(found - allowed.begin());
}

/// Points as they come.
class CloudBuilder {
 public:
  Result<void> add(const Eigen::Vector3d& p, const std::string& name, auto place_of) {
    constexpr double largest = 1e9;
    if (!(p.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= largest))
      return invalid("{}: a coordinate is {}, must be a number of at most 1e9", place_of(),
                     p.allFinite() ? "too large" : "not a number");
    if (points_.size() >= 3 * most_cloud_points)
      return invalid("{}: holds more than {} points", name, most_cloud_points);
    points_.insert(points_.end(), p.data(), p.data() + 3);
    return {};
  }

  Result<Eigen::Matrix3Xd> take(const std::string& name) const {
    if (points_.empty()) return invalid(name + ": holds no point");
    return Eigen::Matrix3Xd(
        Eigen::Map<const Eigen::Matrix3Xd>(points_.data(), 3, Eigen::Index(points_.size() / 3)));
  }

 private:
  std::vector<double> points_;
};

/// Where a line of words has x, y and z; nothing where it does not name all of them.
std::optional<std::array<std::size_t, 3>> columns_of(const std::vector<std::string_view>& words) {
  std::array<std::size_t, 3> columns{};
  for (std::size_t k = 0; k < 3; ++k) {
    const char axis = char('x' + k);
    const auto named = [&](std::string_view word) {
      return (word.size() == 1 || word.substr(1) == "_mm") && (word[0] | 32) == axis;
    };
    const auto found = std::ranges::find_if(words, named);
    if (found == words.end()) return std::nullopt;
    columns[k] = std::size_t(found - words.begin());
  }
  return columns;
}

Result<Eigen::Matrix3Xd> read_lines(std::string_view text, const std::string& name) {
  CloudBuilder draft;
  std::array<std::size_t, 3> columns{0, 1, 2};
  bool first = true;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const auto words = values_in(next_line(text));
    if (words.empty()) continue;
    const auto place = [&] { return fmt::format("{}:{}", name, number); };
    // a file may name its columns first
    if (std::exchange(first, false) && !number_of(words.front())) {
      const auto named = columns_of(words);
      if (!named)
        return invalid(place() +
                       ": names columns, of which x, y, z (or x_mm, y_mm, z_mm) are missing");
      columns = *named;
      continue;
    }
    Eigen::Vector3d p;
    for (std::size_t k = 0; k < 3; ++k) {
      if (columns[k] >= words.size())
        return invalid("{}: holds {} numbers, must be x, y, z", place(), words.size());
      const auto value = number_of(words[columns[k]]);
      if (!value) return invalid("{}: '{}' is no number", place(), words[columns[k]].substr(0, 40));
      p[Eigen::Index(k)] = *value;
    }
    TRY_DO(draft.add(p, name, place));
  }
  return draft.take(name);
}

Result<Eigen::Matrix3Xd> read_vertices(std::string_view bytes, const std::string& name) {
  CloudBuilder draft;
  const auto read = each_ply_item(bytes, name, [&](const PlyItem& item) -> Result<void> {
    if (item.element != "vertex") return {};
    return draft.add(item.xyz, name, [&] { return item.place(name); });
  });
  if (!read) return tl::unexpected(read.error());
  return draft.take(name);
}

}  // namespace

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto value = parse_number<double>(word);
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
  const auto text = read_file(file, largest_text);
  if (!text) return invalid(text.error().message);
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
  bool header = true;
  std::string_view lines = text;
  for (int number = 1; !lines.empty(); ++number) {
    const auto words = values_in(next_line(lines));
    if (words.empty()) continue;
    const bool first = std::exchange(header, false);
    // a CSV file names its columns first
    if (first && !value_of(words.front(), 0, known)) continue;
    const auto place = fmt::format("{}:{}", name, number);
    if (words.size() != coordinates.size())
      return invalid("{}: holds {} values, must be {}", place, words.size(), wanted);
    points.emplace_back();
    if (lines_of) lines_of->push_back(number);
    for (const auto& word : words) {
      const auto value = value_of(word, points.back().size(), known);
      if (!value)
        return invalid("{}: '{}' is no {}, must be {}", place, word,
                       known.empty() ? "number" : "value of its column", wanted);
      points.back().push_back(*value);
    }
  }
  if (points.empty()) return invalid("{}: holds no point, must hold one a line, {}", name, wanted);
  return points;
}

Result<Eigen::Matrix3Xd> read_cloud(std::string_view bytes, const std::string& name) {
  const std::string ending = ending_of(name);
  if (ending == ".ply") return read_vertices(bytes, name);
  for (const char* known : {".xyz", ".txt", ".asc", ".csv"})
    if (ending == known) return read_lines(bytes, name);
  return invalid("{}: its name must end in .ply, .xyz, .txt, .asc or .csv", name);
}

}  // namespace gridshell::preset
