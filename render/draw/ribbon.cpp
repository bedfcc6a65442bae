#include "render/draw/ribbon.h"

#include <algorithm>
#include <cmath>

namespace gridshell::render {

std::uint32_t add_ribbon(Mesh& mesh, const Ribbon& ribbon) {
  const auto first = std::uint32_t(mesh.vertices.size());
  const auto t = tangents(ribbon.points, ribbon.closed);
  const float share = std::clamp(ribbon.radius / widest_radius_mm, 0.f, 1.f);
  const auto side = std::int16_t(std::max(1.f, std::round(32767 * share)));
  for (std::size_t k = 0; k < ribbon.points.size(); ++k) {
    const PackedColour colour = pack(ribbon.colours[k]);
    for (const std::int16_t signed_side : {side, std::int16_t(-side)}) {
      mesh.add(ribbon.points[k], t[k], colour);
      mesh.vertices.back().normal[3] = signed_side;
    }
  }
  return first;
}

void join_points(std::vector<std::uint32_t>& indices, std::uint32_t first, int k, int l) {
  const std::uint32_t a = first + 2 * std::uint32_t(k), b = first + 2 * std::uint32_t(l);
  indices.insert(indices.end(), {a, a + 1, b + 1, a, b + 1, b});
}

}  // namespace gridshell::render
