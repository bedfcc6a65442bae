#include <cstdio>
#include <cstdlib>

#include "engine/footprint/network.h"
#include "engine/formats/network_file.h"
#include "engine/formats/point_file.h"
#include "engine/formats/surface_file.h"
#include "engine/geometry/surface.h"
#include "engine/preset/preset_file.h"
#include "tests/fuzz/targets.h"

namespace gridshell::fuzz {
namespace {

[[noreturn]] void complain(const char* what, const std::string& text) {
  std::fprintf(stderr, "%s\n%s\n", what, text.c_str());
  std::abort();
}

/// Whether the result is an error; aborts if the error has no message.
template <class T>
bool refused(const Result<T>& result, const std::string& text) {
  if (!result && result.error().message.empty()) complain("refused without a word", text);
  return !result;
}

/// Removes the first line from the bytes and returns it.
std::string name_before(std::string_view& bytes) {
  const auto end = bytes.find('\n');
  std::string name(bytes.substr(0, end));
  bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
  return name;
}

/// Points as the columns of a matrix.
template <class Points>
Eigen::Matrix3Xd columns(const Points& points) {
  Eigen::Matrix3Xd all(3, Eigen::Index(points.size()));
  for (Eigen::Index k = 0; k < all.cols(); ++k)
    all.col(k) = Eigen::Vector3d::Map(points[std::size_t(k)].data());
  return all;
}

}  // namespace

void preset(std::string_view bytes) {
  std::vector<preset::Override> overrides;
  if (bytes.starts_with("--set ")) {
    const auto end = bytes.find('\n');
    const auto change = preset::parse_override(std::string(bytes.substr(6, end - 6)));
    if (change) overrides.push_back(*change);
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
  }
  // there is no file: points by name are searched for in a missing folder
  const auto read =
      preset::read_preset_text(std::string(bytes), "/nonexistent/x.toml", "x", overrides);
  if (refused(read, std::string(bytes))) return;
  const std::string text = preset::to_toml(*read);
  const auto again = preset::read_preset_text(text, "/nonexistent/x.toml", "x");
  if (!again) complain("does not read its own text", again.error().message + "\n" + text);
  if (preset::to_toml(*again) != text) complain("comes back as another preset", text);
}

void points(std::string_view bytes) {
  (void)preset::points_in(bytes, "x.csv", {"x", "y"});
  (void)preset::points_in(bytes, "x.csv", {"x", "y", "z"});
  (void)preset::points_in(bytes, "x.csv", {"family", "x"}, {{"u", "v"}, {}});
}

void cloud(std::string_view bytes) {
  const std::string name = name_before(bytes);
  const auto read = preset::read_cloud(bytes, name);
  if (!refused(read, name) && !(read->points.cols() > 0 && read->points.allFinite()))
    complain("holds no points", name);
}

void surface(std::string_view bytes) {
  constexpr std::size_t largest = 50;  // vertices; larger surfaces are slow, and fitted by tests
  const std::string name = name_before(bytes);
  const auto read = preset::read_surface(bytes, name);
  if (refused(read, name)) return;
  if (const auto wrong = preset::surface_error(*read); !wrong.empty())
    complain("does not agree with its own check", wrong);
  if (!read->is_mesh() || read->vertices.size() > largest) return;
  if (const auto mesh = TriangleMesh::make(columns(read->vertices), read->triangles))
    (void)MeshSurface::fit(*mesh, 20);
}

void network(std::string_view bytes) {
  const std::string name = name_before(bytes);
  const auto read = preset::read_network(bytes, name);
  if (refused(read, name)) return;
  if (const auto wrong = preset::network_error(*read); !wrong.empty())
    complain("does not agree with its own check", wrong);
  RodNetwork rods;
  rods.points = columns(read->points);
  rods.rods = read->rods;
  rods.supported.assign(read->points.size(), 0);
  rods.free = rods.supported;
  for (const auto& row : read->supports) rods.supported[std::size_t(row[0])] = 1;
  for (const int point : read->free) rods.free[std::size_t(point)] = 1;
  refused(network_footprint(rods), name);
}

}  // namespace gridshell::fuzz
