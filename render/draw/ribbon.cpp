#include "render/draw/ribbon.h"

#include <algorithm>
#include <cmath>

namespace gridshell::render {
namespace {

std::int16_t share_of_widest(float radius) {
  return std::int16_t(std::clamp(std::round(32767 * radius / widest_radius_mm), 1.f, 32767.f));
}

}  // namespace

std::uint32_t add_ribbon(Mesh& mesh, const Ribbon& ribbon) {
  const auto first = std::uint32_t(mesh.vertices.size());
  const auto t = tangents(ribbon.points, ribbon.closed);
  for (std::size_t k = 0; k < ribbon.points.size(); ++k) {
    const PackedColour colour = pack(ribbon.colours[k]);
    const std::int16_t side = share_of_widest(ribbon.radii[std::min(k, ribbon.radii.size() - 1)]);
    for (const std::int16_t signed_side : {side, std::int16_t(-side)}) {
      mesh.add(ribbon.points[k], t[k], colour);
      mesh.vertices.back().normal[3] = signed_side;
    }
  }
  return first;
}

int reach(const Ribbon& ribbon, int from, int last, float tolerance_mm) {
  constexpr float colour_step = 0.004f, least_cosine = 0.98f;
  const auto count = int(ribbon.points.size());
  // the strip is as wide as its ends are square to it: at a corner it stays short
  const auto goes_along = [&](int edge, const Eigen::Vector3f& along) {
    if (!ribbon.closed && (edge < 0 || edge + 1 >= count)) return true;
    const Eigen::Vector3f step =
        ribbon.points[(edge + 1) % count] - ribbon.points[(edge + count) % count];
    return step.dot(along) >= least_cosine * step.norm() * along.norm();
  };
  const auto within = [&](int to) {
    const Eigen::Vector3f &a = ribbon.points[from], &b = ribbon.points[to % count];
    const Eigen::Vector4f &first = ribbon.colours[from], &second = ribbon.colours[to % count];
    const Eigen::Vector3f along = b - a;
    const float length2 = along.squaredNorm();
    if (length2 == 0 || !goes_along(from - 1, along) || !goes_along(to, along)) return false;
    for (int k = from + 1; k < to; ++k) {
      const Eigen::Vector3f off = ribbon.points[k % count] - a;
      const float part = off.dot(along) / length2;
      if ((off - part * along).squaredNorm() > tolerance_mm * tolerance_mm) return false;
      const Eigen::Vector4f mixed = first + part * (second - first);
      if ((ribbon.colours[k % count] - mixed).cwiseAbs().maxCoeff() > colour_step) return false;
    }
    return true;
  };
  int to = from + 1;
  while (to < last && within(to + 1)) ++to;
  return to;
}

void join_points(std::vector<std::uint32_t>& indices, std::uint32_t first, int k, int l) {
  const std::uint32_t a = first + 2 * std::uint32_t(k), b = first + 2 * std::uint32_t(l);
  indices.insert(indices.end(), {a, a + 1, b + 1, a, b + 1, b});
}

std::vector<std::uint32_t> add_bead(Mesh& mesh, const Eigen::Vector3f& centre,
                                    const Eigen::Vector3f& axis, float radius, BeadShape shape,
                                    const Eigen::Vector4f& colour) {
  const auto first = std::uint32_t(mesh.vertices.size());
  const std::int16_t side = share_of_widest(radius);
  PackedColour packed = pack(colour);
  for (const int up : {0, 1})
    for (const std::int16_t right : {std::int16_t(-side), side}) {
      // thirds of the alpha: bit 0 the side, bit 1 the shape
      packed[3] = std::uint16_t(21845 * (up + (shape == BeadShape::ball ? 2 : 0)));
      mesh.add(centre, axis, packed);
      mesh.vertices.back().normal[3] = right;
    }
  return {first, first + 1, first + 3, first, first + 3, first + 2};
}

}  // namespace gridshell::render
