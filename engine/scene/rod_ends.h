// Variables of a designer: positions and directions of the rods' ends, lengths of the legs, and
// diameters of the rods.
#pragma once

#include <Eigen/Core>

#include "engine/core/result.h"
#include "engine/scene/scene.h"

namespace gridshell {

/// The ends of all rods at the end of the scene's motion: column or entry 2r is the start, 2r + 1
/// the end of rod r.
struct ShellEnds {
  Eigen::Matrix3Xd at;  ///< edge points, mm
  Eigen::VectorXd leg;  ///< from the edge point to the joint next to it, along the rod, mm
  /// unit, along the rod as positions increase; zero if the direction is free
  Eigen::Matrix3Xd direction;
  Eigen::VectorXd diameter;  ///< of rod r, mm; rectangular rods keep their sections
};

ShellEnds ends_of(const Scene& scene);

/// The rows of `[ends] table` in the order of the ends: family (0: u), index of the rod, end (0:
/// begin), x, y, z, leg, tx, ty, tz. Free ends have none.
preset::Points table_of(const Scene& scene, const ShellEnds& ends);

/// The rows of `[rod] table` in the order of the rods: family (0: u), index of the rod, diameter.
preset::Points rod_table_of(const Scene& scene, const ShellEnds& ends);

/// Applies the ends of a table to a scene; other ends are unchanged. Of several rods on one line
/// the first row is the first rod's, and so on. Errors (bad_input): a rod that does not exist or
/// has no constrained end, a leg that is not positive, a zero direction where one is prescribed.
Result<void> apply_ends_table(const preset::Points& table, Scene& scene);

// The second ring: rods that continue outside the boundary by a tail without joints. The far end of
// the tail is pinned where the rod has the net's tangent at the first ring, which makes a clamp
// that can be built.

/// Where the far end of a tail of length l belongs: P + l (1 - k^2 l^2/15) t + (l^2/3) k n, with t
/// the net rod's unit tangent that points outwards and k n its curvature vector at the end P. To
/// leading order in k l a cantilever with a force at its tip has the moment EI k at its root when
/// the tip is off by k l^2/3: the rod keeps the net's tangent where the shell is at its net.
Eigen::Vector3d far_end(const Eigen::Vector3d& end, const Eigen::Vector3d& outwards,
                        const Eigen::Vector3d& curvature, double length);

/// The curvature vector of a net's rod through (u, v), 1/mm: the change of its tangent, by
/// differences, one-sided `inwards` (along the rod, +1 or -1) where the net ends. Errors: those of
/// the net.
Result<Eigen::Vector3d> rod_curvature(const ChebyshevNet& net, Family family,
                                      const Eigen::Vector2d& uv, double inwards);

/// Gives all ends of a scene on a net that are pinned a tail of that length. In the flat it goes
/// straight on. Errors: those of the net.
Result<void> add_second_ring(double length_mm, Scene& scene);

/// (u, v) on the net of a mesh's nodes, but for ghosts: nodes of tails are at their edge point,
/// legs that a design made longer or shorter cover the same piece of the net.
Eigen::Matrix2Xd within_boundary(const Footprint& footprint, const RodMesh& mesh);

/// Puts the nodes of tails straight between the two pins that the scene's motion ends at.
void place_tails(const Scene& scene, const RodMesh& mesh, Eigen::Matrix3Xd& places);

/// Positions on the scene's net of the nodes of a mesh without ghosts; tails as in place_tails().
/// Errors: those of the net.
Result<Eigen::Matrix3Xd> places_on_net(const Scene& scene, const RodMesh& mesh);

}  // namespace gridshell
