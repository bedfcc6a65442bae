#include "engine/preset/cloud_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/preset/mesh_draft.h"
#include "engine/preset/ply.h"
#include "engine/preset/point_file.h"

namespace gridshell::preset {
namespace {

/// Points as they come.
class CloudDraft {
 public:
  Result<void> add(const Eigen::Vector3d& p, const std::string& name, auto place_of) {
    constexpr double largest = 1e9;
    if (!(p.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= largest))
      return fail(Fault::bad_input,
                  fmt::format("{}: a coordinate is {}, must be a number of at most 1e9", place_of(),
                              p.allFinite() ? "too large" : "not a number"));
    if (points_.size() >= 3 * most_cloud_points)
      return fail(Fault::bad_input,
                  fmt::format("{}: holds more than {} points", name, most_cloud_points));
    points_.insert(points_.end(), p.data(), p.data() + 3);
    return {};
  }

  Result<Eigen::Matrix3Xd> take(const std::string& name) const {
    if (points_.empty()) return fail(Fault::bad_input, name + ": holds no point");
    return Eigen::Matrix3Xd(
        Eigen::Map<const Eigen::Matrix3Xd>(points_.data(), 3, Eigen::Index(points_.size() / 3)));
  }

 private:
  std::vector<double> points_;
};

/// The words of a line before its remark, apart by blanks, commas or semicolons.
void split(std::string_view line, std::vector<std::string_view>& words) {
  constexpr std::string_view apart = " \t\r\f\v,;";
  line = line.substr(0, line.find('#'));
  words.clear();
  for (std::size_t at = 0; (at = line.find_first_not_of(apart, at)) != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(apart, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
}

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
  CloudDraft draft;
  std::array<std::size_t, 3> columns{0, 1, 2};
  std::vector<std::string_view> words;
  bool first = true;
  for (std::size_t number = 1; !text.empty(); ++number) {
    split(next_line(text), words);
    if (words.empty()) continue;
    const auto place = [&] { return fmt::format("{}:{}", name, number); };
    // a file may name its columns first
    if (std::exchange(first, false) && !number_of(words.front())) {
      const auto named = columns_of(words);
      if (!named)
        return fail(
            Fault::bad_input,
            place() + ": names columns, of which x, y, z (or x_mm, y_mm, z_mm) are missing");
      columns = *named;
      continue;
    }
    Eigen::Vector3d p;
    for (std::size_t k = 0; k < 3; ++k) {
      if (columns[k] >= words.size())
        return fail(Fault::bad_input,
                    fmt::format("{}: holds {} numbers, must be x, y, z", place(), words.size()));
      const auto value = number_of(words[columns[k]]);
      if (!value)
        return fail(Fault::bad_input,
                    fmt::format("{}: '{}' is no number", place(), words[columns[k]].substr(0, 40)));
      p[Eigen::Index(k)] = *value;
    }
    if (auto added = draft.add(p, name, place); !added) return tl::unexpected(added.error());
  }
  return draft.take(name);
}

Result<Eigen::Matrix3Xd> read_vertices(std::string_view bytes, const std::string& name) {
  CloudDraft draft;
  const auto read = each_ply_item(bytes, name, [&](const PlyItem& item) -> Result<void> {
    if (item.element != "vertex") return {};
    return draft.add(item.xyz, name, [&] { return item.place(name); });
  });
  if (!read) return tl::unexpected(read.error());
  return draft.take(name);
}

}  // namespace

Result<Eigen::Matrix3Xd> read_cloud(std::string_view bytes, const std::string& name) {
  const std::string ending = ending_of(name);
  if (ending == ".ply") return read_vertices(bytes, name);
  for (const char* known : {".xyz", ".txt", ".asc", ".csv"})
    if (ending == known) return read_lines(bytes, name);
  return fail(Fault::bad_input,
              fmt::format("{}: its name must end in .ply, .xyz, .txt, .asc or .csv", name));
}

}  // namespace gridshell::preset
