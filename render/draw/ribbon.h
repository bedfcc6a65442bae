// Rods as ribbons that face the eye: a vertex on either side of every node, moved apart by the
// shader. A ribbon knows how far its edge is, so that a sample is covered by as much of the rod as
// there is in it, however thin.
#pragma once

#include <span>

#include "render/draw/mesh.h"

namespace gridshell::render {

/// A polyline of some width.
struct Ribbon {
  std::span<const Eigen::Vector3f> points;   ///< at least 2, or 3 when closed; mm
  std::span<const Eigen::Vector4f> colours;  ///< linear, one a point
  float radius = 1;                          ///< mm
  bool closed = false;                       ///< the last point joins the first
};

/// The widest radius that vertices can tell; they hold theirs as a share of it.
inline constexpr float widest_radius_mm = 64;

/// Adds two vertices a point, in order, and no triangles: position on the axis, unit tangent, and
/// in the normal's fourth component the radius with the side's sign. Returns the first vertex.
std::uint32_t add_ribbon(Mesh& mesh, const Ribbon& ribbon);

/// The two triangles from point `k` to point `l` of a ribbon with this first vertex.
void join_points(std::vector<std::uint32_t>& indices, std::uint32_t first, int k, int l);

}  // namespace gridshell::render
