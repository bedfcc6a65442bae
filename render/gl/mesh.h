// Vertices and triangles as the shaders read them, of rods (ribbons), joints (beads) and cells
// (patches).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/record/trajectory.h"

namespace gridshell::render {

/// A colour in linear light with alpha, components times 65535.
using PackedColour = std::array<std::uint16_t, 4>;

PackedColour pack(const Eigen::Vector4f& linear);

/// A vertex as the shaders read it (attributes 0, 1, 2).
struct Vertex {
  Eigen::Vector3f position;  ///< mm
  /// unit vector times 32767; radius of a ribbon or bead with the sign of the side (add_ribbon)
  std::array<std::int16_t, 4> normal;
  PackedColour colour;
};

/// Triangles over vertices; the meaning of a vertex's members depends on the shader.
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

// Rods are ribbons and joints beads: strips and cards that face the eye. Their shaders compute the
// fraction of every sample that they cover, however thin they are.

/// A polyline with a width.
struct Ribbon {
  std::span<const Eigen::Vector3f> points;   ///< at least 2, or 3 when closed; mm
  std::span<const Eigen::Vector4f> colours;  ///< linear, one per point
  std::span<const float> radii;              ///< mm, one for all or one per point
  bool closed = false;                       ///< the last point joins the first
};

/// The largest radius that vertices can have. They store the root of theirs over it, so that thin
/// wires and steel tubes have radii right to a hundredth.
inline constexpr float widest_radius_mm = 4096;
/// The radius that a vertex of a ribbon or bead stores, mm.
inline float radius_mm(const Vertex& vertex) {
  const float root = float(vertex.normal[3]) / 32767;
  return widest_radius_mm * root * root;
}

/// Adds two vertices per point, in order, and no triangles: position on the axis, unit tangent, and
/// in the normal's fourth component the root of the radius over widest_radius_mm with the side's
/// sign. Returns the index of the first vertex.
std::uint32_t add_ribbon(Mesh& mesh, const Ribbon& ribbon);

/// The last point, at most `last`, to which a straight piece from point `from` may replace the
/// polyline: all points between are within `tolerance_mm` of it, their colours within a step of a
/// screen's. `last` may be greater than the number of points of a closed ribbon.
int longest_straight_piece(const Ribbon& ribbon, int from, int last, float tolerance_mm);

/// Adds the two triangles from point `k` to point `l` of the ribbon whose first vertex is `first`.
void add_strip_quad(std::vector<std::uint32_t>& indices, std::uint32_t first, int k, int l);

enum class BeadShape { cylinder, ball };  ///< a joint, whose height is 5/3 of its width; a mark

/// Adds a card of four vertices and returns its triangles. A vertex has the centre, the bead's unit
/// axis, the radius with the sign of left or right, and in the colour's alpha (thirds) lower or
/// upper and the shape (bead.vert).
std::vector<std::uint32_t> add_bead(Mesh& mesh, const Eigen::Vector3f& centre,
                                    const Eigen::Vector3f& axis, float radius, BeadShape shape,
                                    const Eigen::Vector4f& colour);

/// The triangles of one cell, a sheet between its rods.
struct CellPatch {
  int cell = 0;
  std::vector<std::uint32_t> indices;
};

/// Adds the vertices of one Coons patch [Coons 1967] per cell, whose edges follow the rods:
/// S(u, v) = (1-v) c0(u) + v c1(u) + (1-u) d0(v) + u d1(v) - bilinear(corners).
/// Returns the triangles, which the caller orders by depth. `colours` are linear, one per cell;
/// cells whose alpha is 0 are left out. A patch is as coarse as the tolerance allows.
std::vector<CellPatch> add_cell_patches(Mesh& mesh, const record::Layout& layout,
                                        const Eigen::Matrix3Xd& nodes,
                                        std::span<const Eigen::Vector4f> colours,
                                        float tolerance_mm);

}  // namespace gridshell::render
