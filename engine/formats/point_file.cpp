#include "engine/formats/point_file.h"

#include <fmt/format.h>
#include <cctype>
#include <cmath>

#include "engine/core/file_io.h"
#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/obj_ply.h"
#include "engine/formats/table_file.h"

namespace gridshell::preset {
namespace {

/// Collects the points of a cloud.
class CloudBuilder {
 public:
  Result<void> add(const Eigen::Vector3d& p, const std::string& name, auto where) {
    constexpr double largest = 1e9;
    if (!(p.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= largest))
      return invalid("{}: got a coordinate that is {}, expected a number of at most 1e9", where(),
                     p.allFinite() ? "too large" : "not a number");
    if (points_.size() >= 3 * most_cloud_points)
      return invalid("{}: got more than {} points", name, most_cloud_points);
    points_.insert(points_.end(), p.data(), p.data() + 3);
    return {};
  }

  Result<Cloud> take(const std::string& name, std::size_t empty_rows) const {
    if (points_.empty()) return invalid(name + ": got no point");
    return Cloud{
        Eigen::Map<const Eigen::Matrix3Xd>(points_.data(), 3, Eigen::Index(points_.size() / 3)),
        empty_rows};
  }

 private:
  std::vector<double> points_;
};

Result<Cloud> read_rows(std::string_view text, const std::string& name, double unit_mm) {
  TRY(table, read_table(text, name, {{"x"}, {"y"}, {"z"}},
                        {.longer_rows = true, .empty_rows = true, .unit_mm = unit_mm}));
  CloudBuilder builder;
  for (std::size_t row = 0; row < table->rows(); ++row)
    TRY_DO(builder.add({table->at(row, 0), table->at(row, 1), table->at(row, 2)}, name,
                       [&] { return fmt::format("{}:{}", name, table->lines[row]); }));
  return builder.take(name, table->empty_rows);
}

Result<Cloud> read_vertices(std::string_view bytes, const std::string& name, double unit_mm) {
  CloudBuilder builder;
  std::size_t empty = 0;
  const auto read = each_ply_item(bytes, name, [&](const PlyItem& item) -> Result<void> {
    if (item.element != "vertex") return {};
    if (item.has_xyz && item.xyz.array().isNaN().all()) return ++empty, Result<void>();
    return builder.add(unit_mm * item.xyz, name, [&] { return item.location(name); });
  });
  if (!read) return tl::unexpected(read.error());
  return builder.take(name, empty);
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

Result<Points> points_in(std::string_view text, const std::string& name,
                         const std::vector<std::string>& coordinates,
                         const std::vector<std::vector<std::string>>& words) {
  std::vector<TableColumn> columns;
  for (std::size_t k = 0; k < coordinates.size(); ++k)
    columns.push_back({coordinates[k], k < words.size() ? words[k] : std::vector<std::string>()});
  TRY(table, read_table(text, name, columns));
  Points points;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    const auto first = table->values.begin() + std::ptrdiff_t(row * table->columns);
    points.emplace_back(first, first + std::ptrdiff_t(table->columns));
  }
  return points;
}

Result<Cloud> read_cloud(std::string_view bytes, const std::string& name, double unit_mm) {
  const std::string ending = ending_of(name);
  if (ending == ".ply") return read_vertices(bytes, name, unit_mm);
  for (const char* known : {".xyz", ".txt", ".asc", ".csv", ".pts"})
    if (ending == known) return read_rows(bytes, name, unit_mm);
  return invalid("{}: expected a name that ends in .ply, .xyz, .txt, .asc, .csv or .pts", name);
}

}  // namespace gridshell::preset
