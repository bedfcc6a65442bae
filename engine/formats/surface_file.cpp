#include "engine/formats/surface_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "engine/core/text.h"
#include "engine/core/try.h"
#include "engine/formats/obj_ply.h"
#include "engine/formats/plain_text.h"
#include "engine/formats/table_file.h"

namespace gridshell::preset {

Result<void> MeshBuilder::add_vertex(std::vector<double> xyz, const std::string& where) {
  constexpr double largest = 1e9;
  for (double& value : xyz) {
    value *= unit_mm_;
    if (!(std::abs(value) <= largest))
      return invalid("{}: got a coordinate that is {}, expected a number of at most 1e9", where,
                     std::isfinite(value) ? "too large" : "not a number");
  }
  const auto [found, fresh] = at_.try_emplace(xyz, int(mesh_.vertices.size()));
  // in a file of separate triangles each has three vertices
  const bool many = mesh_.vertices.size() == most_vertices;
  if (many || number_.size() == 3 * most_triangles)
    return invalid("{}: got more than {} vertices{}, expected fewer", where,
                   many ? most_vertices : 3 * most_triangles,
                   many ? " at different positions" : "");
  number_.push_back(found->second);
  if (fresh) mesh_.vertices.push_back(xyz);
  return {};
}

Result<void> MeshBuilder::add_polygon(const std::vector<long>& corners, const std::string& where) {
  if (corners.size() < 3)
    return invalid("{}: got a polygon of {} corners, expected 3 or more", where, corners.size());
  std::vector<int> ring;
  for (const long corner : corners) {
    if (corner < 0 || corner >= long(number_.size()))
      return invalid("{}: got the number of no vertex, expected one of the {} before it", where,
                     number_.size());
    ring.push_back(number_[std::size_t(corner)]);
  }
  if (mesh_.triangles.size() + ring.size() - 2 > most_triangles)
    return invalid("{}: got more than {} triangles, expected fewer", where, most_triangles);
  for (std::size_t k = 2; k < ring.size(); ++k)
    if (ring[0] != ring[k - 1] && ring[k - 1] != ring[k] && ring[k] != ring[0])
      mesh_.triangles.push_back({ring[0], ring[k - 1], ring[k]});
  return {};
}

Result<SurfaceData> MeshBuilder::take(const std::string& name) {
  if (!mesh_.triangles.empty()) return std::move(mesh_);
  return invalid(name + ": got no triangle, expected a mesh of triangles");
}

// STL: triangles by the coordinates of their corners, as text or as 50 bytes each.

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as they are");

constexpr std::size_t header = 84, triangle = 50;

/// The number of triangles in the header of a binary file.
std::size_t count_in(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= header) std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return count;
}

/// Adds a corner; every third one completes a triangle.
Result<void> add_corner(MeshBuilder& builder, const std::vector<double>& xyz,
                        const std::string& where) {
  if (auto added = builder.add_vertex(xyz, where); !added) return added;
  const long count = long(builder.vertices());
  if (count % 3 != 0) return {};
  return builder.add_polygon({count - 3, count - 2, count - 1}, where);
}

Result<SurfaceData> read_binary(std::string_view bytes, const std::string& name, double unit_mm) {
  MeshBuilder builder(unit_mm);
  for (std::size_t k = 0; k < count_in(bytes); ++k)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      float xyz[3];
      // the normal comes first
      std::memcpy(xyz, bytes.data() + header + k * triangle + 12 * (corner + 1), sizeof(xyz));
      TRY_DO(add_corner(builder, {xyz[0], xyz[1], xyz[2]},
                        fmt::format("{}: triangle {}", name, k + 1)));
    }
  return builder.take(name);
}

Result<SurfaceData> read_text(std::string_view bytes, const std::string& name, double unit_mm) {
  MeshBuilder builder(unit_mm);
  bool ended = false;
  for (int number = 1; !bytes.empty(); ++number) {
    const auto words = words_in(next_line(bytes));
    if (words.empty()) continue;
    const std::string first = lower(words[0]);
    if (first == "solid") ended = false;
    if (first == "endsolid") ended = true;
    if (first != "vertex") continue;
    const auto where = fmt::format("{}:{}", name, number);
    std::vector<double> xyz;
    for (std::size_t k = 1; k < words.size(); ++k)
      if (const auto value = number_of(words[k])) xyz.push_back(*value);
    if (xyz.size() != 3 || words.size() != 4)
      return invalid(where + ": expected a vertex of three numbers, vertex x y z");
    TRY_DO(add_corner(builder, xyz, where));
  }
  if (builder.vertices() % 3 != 0)
    return invalid("{}: got {} vertices, expected three per triangle", name, builder.vertices());
  if (!ended) return invalid("{}: ends without \"endsolid\": is it cut short?", name);
  return builder.take(name);
}

constexpr std::size_t most_heights = 100000, least_side = 4;

/// The different values of a coordinate, rising; values that differ by round-off are merged.
std::vector<double> values_of(const NumberTable& table, std::size_t column) {
  std::vector<double> values;
  for (std::size_t row = 0; row < table.rows(); ++row) values.push_back(table.at(row, column));
  std::ranges::sort(values);
  const double alike = 1e-6 * (values.back() - values.front());
  values.erase(
      std::unique(values.begin(), values.end(), [&](double a, double b) { return b - a <= alike; }),
      values.end());
  return values;
}

std::size_t nearest(const std::vector<double>& values, double value) {
  const auto after = std::ranges::lower_bound(values, value);
  if (after == values.begin()) return 0;
  const std::size_t k = std::size_t(after - values.begin());
  return k == values.size() || value - values[k - 1] < values[k] - value ? k - 1 : k;
}

/// Whether programs write this number, here times `scale`, for a missing height.
bool marks_a_hole(double z, double scale) {
  for (const double mark : {-9999.0, -99999.0, -999999.0, -32767.0, -32768.0})
    if (z == mark * scale) return true;
  return std::abs(z) > 1e30 * scale;
}

Result<SurfaceData> read_heights(std::string_view bytes, const std::string& name, double unit_mm) {
  const std::vector<TableColumn> xyz{{"x"}, {"y"}, {"z"}};
  TRY(table, read_table(bytes, name, xyz, {.unit_mm = unit_mm}));
  const std::size_t points = table->rows();
  for (std::size_t k = 0; k < points; ++k)
    if (const double z = table->at(k, 2), scale = table->scale[2]; marks_a_hole(z, scale))
      return invalid(
          "{}:{}: got a height of {:g}, which marks a hole, expected a complete rectangle", name,
          table->lines[k], z / scale);
  if (points > most_heights)
    return invalid("{}: got {} points, expected at most {}", name, points, most_heights);
  SurfaceData grid{values_of(*table, 0), values_of(*table, 1), {}, {}, {}};
  const std::size_t columns = grid.x.size(), rows = grid.y.size();
  if (columns < least_side || rows < least_side)
    return invalid(
        "{}: got {} different x and {} different y, expected a grid of at least 4 x 4 points", name,
        columns, rows);
  const auto size_text = fmt::format("{} points on a grid of {} x {}", points, columns, rows);
  // scattered points form a grid with as many nodes as the square of their number
  if (columns * rows > 4 * points)
    return invalid("{}: got {}, expected a complete rectangle", name, size_text);
  grid.z.assign(rows, std::vector<double>(columns, std::nan("")));
  for (std::size_t k = 0; k < points; ++k) {
    const double x = table->at(k, 0), y = table->at(k, 1);
    double& z = grid.z[nearest(grid.y, y)][nearest(grid.x, x)];
    if (!std::isnan(z))
      return invalid("{}:{}: got a second point at ({:g}, {:g}), expected one", name,
                     table->lines[k], x, y);
    z = table->at(k, 2);
  }
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i)
      if (std::isnan(grid.z[j][i]))
        return invalid(
            "{}: got {}, and none at ({:g}, {:g}): a hole, expected a complete rectangle", name,
            size_text, grid.x[i], grid.y[j]);
  return grid;
}

std::string rising_error(const char* key, const std::vector<double>& values) {
  if (values.size() < least_side)
    return fmt::format("{}: got {} numbers, expected at least 4", key, values.size());
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(values[k] > values[k - 1]))
      return fmt::format("{}: got {:g} before {:g}, expected rising numbers", key, values[k - 1],
                         values[k]);
  return "";
}

std::string mesh_error(const SurfaceData& mesh) {
  MeshBuilder builder(1);
  for (const auto& vertex : mesh.vertices) {
    if (vertex.size() != 3) return "vertices_mm: expected points [x, y, z]";
    if (auto added = builder.add_vertex(vertex, "vertices_mm"); !added)
      return added.error().message;
  }
  for (const auto& [a, b, c] : mesh.triangles)
    if (auto added = builder.add_polygon({a, b, c}, "triangles"); !added)
      return added.error().message;
  return "";
}

// Each of the following functions reads a complete file; `name` is its name in messages. Errors
// (bad_input): text that is not of the format, with its line or the number of its vertex or
// triangle.
Result<SurfaceData> read_obj(std::string_view bytes, const std::string& name, double unit_mm) {
  MeshBuilder builder(unit_mm);
  return read_obj_lines(
             bytes, name, "f",
             {[&](const auto& xyz, const auto& at) { return builder.add_vertex(xyz, at); },
              [&](const auto& corners, const auto& at) {
                return builder.add_polygon(corners, at);
              }})
      .and_then([&](const auto&) { return builder.take(name); });
}

Result<SurfaceData> read_ply(std::string_view bytes, const std::string& name, double unit_mm) {
  MeshBuilder builder(unit_mm);
  const auto read = each_ply_item(bytes, name, [&](const PlyItem& item) -> Result<void> {
    if (item.element == "vertex")
      return builder.add_vertex({item.xyz.x(), item.xyz.y(), item.xyz.z()}, item.location(name));
    if (item.element == "face") return builder.add_polygon(item.corners, item.location(name));
    if (item.element == "tristrips")
      return invalid("{}: got strips of triangles, expected faces", item.location(name));
    return {};
  });
  if (!read) return tl::unexpected(read.error());
  return builder.take(name);
}

Result<SurfaceData> read_stl(std::string_view bytes, const std::string& name, double unit_mm) {
  // a binary file may start with "solid", too, but has a size that fits its number of triangles
  if (bytes.size() >= header && bytes.size() == header + triangle * count_in(bytes))
    return read_binary(bytes, name, unit_mm);
  std::string storage;
  const std::string_view text = plain_text(bytes, storage);
  const std::size_t first = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  if (lower(text.substr(first, 5)) == "solid") return read_text(text, name, unit_mm);
  return invalid(
      "{}: got no STL: it begins without \"solid\", and its {} bytes are not those of the {} "
      "triangles that it says",
      name, bytes.size(), count_in(bytes));
}

}  // namespace

std::string surface_error(const SurfaceData& surface) {
  if (surface.is_mesh()) return mesh_error(surface);
  for (const auto& [key, values] : {std::pair("x_mm", &surface.x), {"y_mm", &surface.y}})
    if (auto wrong = rising_error(key, *values); !wrong.empty()) return wrong;
  if (surface.x.size() * surface.y.size() > most_heights)
    return fmt::format("got more than {} heights", most_heights);
  if (surface.z.size() != surface.y.size())
    return fmt::format("z_mm: got {} rows, expected one for each of the {} y", surface.z.size(),
                       surface.y.size());
  for (const auto& row : surface.z)
    if (row.size() != surface.x.size())
      return fmt::format("z_mm: got a row of {} heights, expected one for each of the {} x",
                         row.size(), surface.x.size());
  return "";
}

Result<SurfaceData> read_surface(std::string_view bytes, const std::string& name, double unit_mm) {
  const std::string ending = ending_of(name);
  if (ending == ".csv" || ending == ".txt") return read_heights(bytes, name, unit_mm);
  if (ending == ".obj") return read_obj(bytes, name, unit_mm);
  if (ending == ".ply") return read_ply(bytes, name, unit_mm);
  if (ending == ".stl") return read_stl(bytes, name, unit_mm);
  return invalid(
      "{}: expected a name that ends in .csv or .txt (heights x, y, z over a grid), or .obj, .ply "
      "or .stl (triangles)",
      name);
}

}  // namespace gridshell::preset
