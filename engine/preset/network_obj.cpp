// Networks as Wavefront OBJ: lines "v x y z" and "l a b c ...", all others left out.
#include <fmt/format.h>

#include "engine/preset/mesh_draft.h"
#include "engine/preset/network_draft.h"

namespace gridshell::preset {

Result<NetworkData> read_network_obj(std::string_view bytes, const std::string& name) {
  NetworkDraft draft;
  for (int number = 1; !bytes.empty(); ++number) {
    const auto words = blank_apart(next_line(bytes));
    if (words.empty() || (words[0] != "v" && words[0] != "l")) continue;
    const auto place = fmt::format("{}:{}", name, number);
    if (words[0] == "v") {
      std::vector<double> xyz;
      for (std::size_t k = 1; k < words.size() && k < 4; ++k)
        if (const auto value = number_of(words[k])) xyz.push_back(*value);
      if (xyz.size() != 3)
        return fail(Fault::bad_input, place + ": a vertex must have three numbers, v x y z");
      if (auto added = draft.add_point(xyz, place); !added) return tl::unexpected(added.error());
      continue;
    }
    std::vector<int> points;
    for (std::size_t k = 1; k < words.size(); ++k) {
      const auto vertex = obj_vertex(words[k], draft.points());
      if (!vertex)
        return fail(Fault::bad_input, fmt::format("{}: '{}' is no vertex, must be its number",
                                                  place, words[k].substr(0, 40)));
      const auto point = draft.point(*vertex, place);
      if (!point) return tl::unexpected(point.error());
      points.push_back(*point);
    }
    if (auto added = draft.add_rod(std::move(points), 0, place); !added)
      return tl::unexpected(added.error());
  }
  return draft.join_crossings(name).and_then([&] { return draft.take(name); });
}

}  // namespace gridshell::preset
