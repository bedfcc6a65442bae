// Vertices and triangles as the shaders read them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/record/trajectory.h"

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

/// Triangles over vertices; what a vertex contains differs from shader to shader.
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

// Rods as ribbons and joints as beads: strips and cards that face the eye and know in every sample
// how much of it they cover, however thin they are.

/// A polyline of some width.
struct Ribbon {
  std::span<const Eigen::Vector3f> points;   ///< at least 2, or 3 when closed; mm
  std::span<const Eigen::Vector4f> colours;  ///< linear, one per point
  std::span<const float> radii;              ///< mm, one for all or one per point
  bool closed = false;                       ///< the last point joins the first
};

/// The widest radius that vertices can have; they store theirs as a fraction of it.
inline constexpr float widest_radius_mm = 64;

/// Adds two vertices a point, in order, and no triangles: position on the axis, unit tangent, and
/// in the normal's fourth component the radius with the side's sign. Returns the first vertex.
std::uint32_t add_ribbon(Mesh& mesh, const Ribbon& ribbon);

/// How far from point `from` a straight piece may go, at most to `last`: all points between lie
/// within `tolerance_mm` of it, their colours within a step of a screen's. (`last` may be after
/// the last point of a closed ribbon.)
int longest_straight_piece(const Ribbon& ribbon, int from, int last, float tolerance_mm);

/// The two triangles from point `k` to point `l` of a ribbon with this first vertex.
void add_strip_quad(std::vector<std::uint32_t>& indices, std::uint32_t first, int k, int l);

enum class BeadShape { cylinder, ball };  ///< a joint, 3 wide and 5 high; or a ball

/// Adds a card of four vertices and returns its triangles: centre, the bead's unit axis, radius and
/// a side's sign, and in the colour's alpha the other side's sign and the shape.
std::vector<std::uint32_t> add_bead(Mesh& mesh, const Eigen::Vector3f& centre,
                                    const Eigen::Vector3f& axis, float radius, BeadShape shape,
                                    const Eigen::Vector4f& colour);

// The cells as sheets spanned between their rods.

/// The triangles of one cell.
struct CellPatch {
  int cell = 0;
  std::vector<std::uint32_t> indices;
};

/// One Coons patch [Coons 1967] a cell, so that its edges lie on the rods however these bend:
/// S(u, v) = (1-v) c0(u) + v c1(u) + (1-u) d0(v) + u d1(v) - bilinear(corners).
/// Adds their vertices to the mesh; their triangles are for whoever knows the order. `colours` are
/// linear, one per cell; cells whose alpha is 0 are left out. A patch is as coarse as may be with
/// all points that it leaves out within the tolerance.
std::vector<CellPatch> add_cell_patches(Mesh& mesh, const record::Layout& layout,
                                        const Eigen::Matrix3Xd& nodes,
                                        std::span<const Eigen::Vector4f> colours,
                                        float tolerance_mm);

}  // namespace gridshell::render
