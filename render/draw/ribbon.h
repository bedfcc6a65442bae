// Rods as ribbons and joints as beads: strips and cards that face the eye and know in every sample
// how much of it they cover, however thin they are.
#pragma once

#include <span>

#include "render/draw/mesh.h"

namespace gridshell::render {

/// A polyline of some width.
struct Ribbon {
  std::span<const Eigen::Vector3f> points;   ///< at least 2, or 3 when closed; mm
  std::span<const Eigen::Vector4f> colours;  ///< linear, one a point
  std::span<const float> radii;              ///< mm, one for all or one a point
  bool closed = false;                       ///< the last point joins the first
};

/// The widest radius that vertices can tell; they hold theirs as a share of it.
inline constexpr float widest_radius_mm = 64;

/// Adds two vertices a point, in order, and no triangles: position on the axis, unit tangent, and
/// in the normal's fourth component the radius with the side's sign. Returns the first vertex.
std::uint32_t add_ribbon(Mesh& mesh, const Ribbon& ribbon);

/// How far from point `from` a straight piece may go, at most to `last`: all points between lie
/// within `tolerance_mm` of it, their colours within a step of a screen's. (`last` may lie beyond
/// the last point of a closed ribbon.)
int reach(const Ribbon& ribbon, int from, int last, float tolerance_mm);

/// The two triangles from point `k` to point `l` of a ribbon with this first vertex.
void join_points(std::vector<std::uint32_t>& indices, std::uint32_t first, int k, int l);

enum class BeadShape { flat, ball };  ///< a joint, three fifths as high as wide; or a ball

/// Adds a card of four vertices and returns its triangles: centre, the bead's unit axis, radius and
/// a side's sign, and in the colour's alpha the other side's sign and the shape.
std::vector<std::uint32_t> add_bead(Mesh& mesh, const Eigen::Vector3f& centre,
                                    const Eigen::Vector3f& axis, float radius, BeadShape shape,
                                    const Eigen::Vector4f& colour);

}  // namespace gridshell::render
