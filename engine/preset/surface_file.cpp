#include "engine/preset/surface_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/preset/mesh_draft.h"
#include "engine/preset/point_file.h"

namespace gridshell::preset {
namespace {

constexpr std::size_t most_heights = 100000, least_side = 4;

/// The values that a coordinate takes, rising; what differs by round-off is one.
std::vector<double> values_of(const Points& points, std::size_t coordinate) {
  std::vector<double> values;
  for (const auto& point : points) values.push_back(point[coordinate]);
  std::sort(values.begin(), values.end());
  const double alike = 1e-6 * (values.back() - values.front());
  values.erase(
      std::unique(values.begin(), values.end(), [&](double a, double b) { return b - a <= alike; }),
      values.end());
  return values;
}

std::size_t nearest(const std::vector<double>& values, double value) {
  const auto after = std::lower_bound(values.begin(), values.end(), value);
  if (after == values.begin()) return 0;
  const std::size_t k = std::size_t(after - values.begin());
  return k == values.size() || value - values[k - 1] < values[k] - value ? k - 1 : k;
}

Result<SurfaceData> read_heights(std::string_view bytes, const std::string& name) {
  std::vector<int> lines;
  const auto points = points_in(std::string(bytes), name, {"x", "y", "z"}, {}, &lines);
  if (!points) return tl::unexpected(points.error());
  if (points->size() > most_heights)
    return fail(Fault::bad_input, fmt::format("{}: holds {} points, must be at most {}", name,
                                              points->size(), most_heights));
  SurfaceData grid{values_of(*points, 0), values_of(*points, 1), {}, {}, {}};
  const std::size_t columns = grid.x.size(), rows = grid.y.size();
  if (columns < least_side || rows < least_side)
    return fail(Fault::bad_input, fmt::format("{}: {} different x and {} different y, must be a "
                                              "grid of at least 4 x 4 places",
                                              name, columns, rows));
  const auto holds =
      fmt::format("holds {} points on a grid of {} x {} places", points->size(), columns, rows);
  // what lies far from any grid has as many places as the square of its points
  if (columns * rows > 4 * points->size())
    return fail(Fault::bad_input, fmt::format("{}: {}, must be a whole rectangle", name, holds));
  grid.z.assign(rows, std::vector<double>(columns, std::nan("")));
  for (std::size_t k = 0; k < points->size(); ++k) {
    const auto& point = (*points)[k];
    double& z = grid.z[nearest(grid.y, point[1])][nearest(grid.x, point[0])];
    if (!std::isnan(z))
      return fail(Fault::bad_input,
                  fmt::format("{}:{}: a second point at ({:g}, {:g}), must be one", name, lines[k],
                              point[0], point[1]));
    z = point[2];
  }
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i)
      if (std::isnan(grid.z[j][i]))
        return fail(Fault::bad_input,
                    fmt::format("{}: {}, and none at ({:g}, {:g}): a hole, must be a whole "
                                "rectangle",
                                name, holds, grid.x[i], grid.y[j]));
  return grid;
}

std::string rising_fault(const char* key, const std::vector<double>& values) {
  if (values.size() < least_side)
    return fmt::format("{} holds {} numbers, must be at least 4", key, values.size());
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(values[k] > values[k - 1]))
      return fmt::format("{} must rise, {:g} stands before {:g}", key, values[k - 1], values[k]);
  return "";
}

std::string mesh_fault(const SurfaceData& mesh) {
  MeshDraft draft;
  for (const auto& vertex : mesh.vertices) {
    if (vertex.size() != 3) return "vertices_mm must be points [x, y, z]";
    if (auto added = draft.add_vertex(vertex, "vertices_mm"); !added) return added.error().message;
  }
  for (const auto& [a, b, c] : mesh.triangles)
    if (auto added = draft.add_polygon({a, b, c}, "triangles"); !added)
      return added.error().message;
  return "";
}

}  // namespace

std::string surface_fault(const SurfaceData& surface) {
  if (surface.is_mesh()) return mesh_fault(surface);
  for (const auto& [key, values] : {std::pair("x_mm", &surface.x), {"y_mm", &surface.y}})
    if (auto wrong = rising_fault(key, *values); !wrong.empty()) return wrong;
  if (surface.x.size() * surface.y.size() > most_heights)
    return fmt::format("holds more than {} heights", most_heights);
  if (surface.z.size() != surface.y.size())
    return fmt::format("z_mm holds {} rows, must be one for each of the {} y", surface.z.size(),
                       surface.y.size());
  for (const auto& row : surface.z)
    if (row.size() != surface.x.size())
      return fmt::format("z_mm holds a row of {} heights, must be one for each of the {} x",
                         row.size(), surface.x.size());
  return "";
}

Result<SurfaceData> read_surface(std::string_view bytes, const std::string& name) {
  const std::string ending = ending_of(name);
  if (ending == ".csv" || ending == ".txt") return read_heights(bytes, name);
  if (ending == ".obj") return read_obj(bytes, name);
  if (ending == ".ply") return read_ply(bytes, name);
  if (ending == ".stl") return read_stl(bytes, name);
  return fail(Fault::bad_input,
              fmt::format("{}: its name must end in .csv or .txt (heights x, y, z over a grid), or "
                          ".obj, .ply or .stl (triangles)",
                          name));
}

}  // namespace gridshell::preset
