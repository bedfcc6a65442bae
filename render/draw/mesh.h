// Triangles with smooth normals and linear colours, and the solids that a shell is made of.
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

/// Counter-clockwise triangles, seen from outside.
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

/// A tube around a polyline.
struct Tube {
  std::span<const Eigen::Vector3f> points;   ///< at least 2, or 3 when closed; mm
  std::span<const Eigen::Vector4f> colours;  ///< linear, one a point
  float radius = 1;                          ///< mm
  int sides = 8;
  bool closed = false;  ///< the last point joins the first; else round caps close the ends
};

/// Rings of `sides` vertices stand on the bisecting planes; the frame that carries them is
/// transported in parallel [Bishop 1975], so that no facet twists about the rod.
void add_tube(Mesh& mesh, const Tube& tube);

/// A short upright cylinder with rounded rims about `centre`, its axis along the unit vector
/// `axis`.
void add_button(Mesh& mesh, const Eigen::Vector3f& centre, const Eigen::Vector3f& axis,
                float radius, float half_height, int sides, const Eigen::Vector4f& colour);

/// A closed cone from the middle of its base to its tip.
void add_cone(Mesh& mesh, const Eigen::Vector3f& base, const Eigen::Vector3f& tip, float radius,
              int sides, const Eigen::Vector4f& colour);

void add_ball(Mesh& mesh, const Eigen::Vector3f& centre, float radius, int sides,
              const Eigen::Vector4f& colour);

}  // namespace gridshell::render
