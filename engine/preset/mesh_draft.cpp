#include "engine/preset/mesh_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gridshell::preset {

std::vector<std::string_view> blank_apart(std::string_view line) {
  constexpr std::string_view blanks = " \t\r\f\v";
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = line.find_first_not_of(blanks, at)) != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

Result<void> MeshDraft::add_vertex(const std::vector<double>& xyz, const std::string& place) {
  constexpr double largest = 1e9;
  for (const double value : xyz)
    if (!(std::abs(value) <= largest))
      return fail(Fault::bad_input,
                  fmt::format("{}: a coordinate is {}, must be a number of at most 1e9", place,
                              std::isfinite(value) ? "too large" : "not a number"));
  const auto [found, fresh] = at_.try_emplace(xyz, int(mesh_.vertices.size()));
  // a triangle that stands by itself brings three vertices
  if (mesh_.vertices.size() == most_vertices || number_.size() == 3 * most_triangles)
    return fail(Fault::bad_input,
                fmt::format("{}: more than {} vertices, must be fewer", place, most_vertices));
  number_.push_back(found->second);
  if (fresh) mesh_.vertices.push_back(xyz);
  return {};
}

Result<void> MeshDraft::add_polygon(const std::vector<long>& corners, const std::string& place) {
  if (corners.size() < 3)
    return fail(Fault::bad_input, fmt::format("{}: a polygon of {} corners, must have 3 or more",
                                              place, corners.size()));
  std::vector<int> ring;
  for (const long corner : corners) {
    if (corner < 0 || corner >= long(number_.size()))
      return fail(Fault::bad_input,
                  fmt::format("{}: names a vertex that is none of the {} before it", place,
                              number_.size()));
    ring.push_back(number_[std::size_t(corner)]);
  }
  if (mesh_.triangles.size() + ring.size() - 2 > most_triangles)
    return fail(Fault::bad_input,
                fmt::format("{}: more than {} triangles, must be fewer", place, most_triangles));
  for (std::size_t k = 2; k < ring.size(); ++k)
    if (ring[0] != ring[k - 1] && ring[k - 1] != ring[k] && ring[k] != ring[0])
      mesh_.triangles.push_back({ring[0], ring[k - 1], ring[k]});
  return {};
}

Result<SurfaceData> MeshDraft::take(const std::string& name) {
  if (!mesh_.triangles.empty()) return std::move(mesh_);
  return fail(Fault::bad_input, name + ": holds no triangle, must be a mesh of triangles");
}

}  // namespace gridshell::preset
