#include "render/draw/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace gridshell::render {
std::vector<Eigen::Vector3f> tangents(std::span<const Eigen::Vector3f> points, bool closed) {
  const std::size_t n = points.size();
  std::vector<Eigen::Vector3f> result(n, Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const Eigen::Vector3f direction = (points[next] - points[i]).stableNormalized();
    result[i] += direction;
    result[next] += direction;
  }
  for (std::size_t i = 0; i < n; ++i) {
    // an edge without length, or one that turns back, keeps the direction before it
    if (result[i].norm() < 1e-6f) result[i] = i ? result[i - 1] : Eigen::Vector3f::UnitX();
    result[i].normalize();
  }
  return result;
}

void Mesh::clear() {
  vertices.clear();
  indices.clear();
}

PackedColour pack(const Eigen::Vector4f& linear) {
  PackedColour packed;
  for (int k = 0; k < 4; ++k)
    packed[k] = std::uint16_t(65535 * std::clamp(linear[k], 0.f, 1.f) + 0.5f);
  return packed;
}

std::uint32_t Mesh::add(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                        const PackedColour& colour) {
  Vertex v{position, {}, colour};
  // towards zero: rounding would cost a call for each of a hundred thousand
  for (int k = 0; k < 3; ++k) v.normal[k] = std::int16_t(32767 * std::clamp(normal[k], -1.f, 1.f));
  vertices.push_back(v);
  return std::uint32_t(vertices.size() - 1);
}

void Mesh::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  indices.insert(indices.end(), {a, b, c});
}

}  // namespace gridshell::render
