// Networks as Wavefront OBJ: vertices and lines.
#include "engine/preset/network_draft.h"
#include "engine/preset/obj_file.h"

namespace gridshell::preset {

Result<NetworkData> read_network_obj(std::string_view bytes, const std::string& name) {
  NetworkDraft draft;
  const auto add_rod = [&](const std::vector<long>& vertices, const std::string& at) {
    std::vector<int> points;
    for (const long vertex : vertices) {
      const auto point = draft.point(vertex, at);
      if (!point) return Result<void>(tl::unexpected(point.error()));
      points.push_back(*point);
    }
    return draft.add_rod(std::move(points), 0, at);
  };
  return read_obj_lines(
             bytes, name, "l",
             {[&](const auto& xyz, const auto& at) { return draft.add_point(xyz, at); }, add_rod})
      .and_then([&] { return draft.join_crossings(name); })
      .and_then([&] { return draft.take(name); });
}

}  // namespace gridshell::preset
