// Vertices and triangles as the shaders read them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gridshell::render {

/// Linear light and alpha, times 65535.
using PackedColour = std::array<std::uint16_t, 4>;

PackedColour pack(const Eigen::Vector4f& linear);

/// As the shaders read it (attributes 0, 1, 2).
struct Vertex {
  Eigen::Vector3f position;            ///< mm
  std::array<std::int16_t, 4> normal;  ///< unit vector times 32767, and of a ribbon its side
  PackedColour colour;
};

/// Triangles over vertices; what a vertex tells differs from shader to shader.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;

  void clear();
  std::uint32_t add(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                    const PackedColour& colour);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
};

/// Unit tangents at the points of a polyline: the mean of the edges' directions on either side.
std::vector<Eigen::Vector3f> tangents(std::span<const Eigen::Vector3f> points, bool closed);

}  // namespace gridshell::render
