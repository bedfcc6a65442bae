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
  Eigen::VectorXd diameter;  ///< one per rod, mm; without meaning for rectangular rods
};

/// The ends of a scene at the end of its motion.
ShellEnds ends_of(const Scene& scene);

/// The rows of `[ends] table` in the order of the ends: family (0: u), index of the rod, end (0:
/// start), x, y, z, leg, tx, ty, tz. Free ends have no row.
preset::Points table_of(const Scene& scene, const ShellEnds& ends);

/// The rows of `[rod] table` in the order of the rods: family (0: u), index of the rod, diameter.
preset::Points rod_table_of(const Scene& scene, const ShellEnds& ends);

/// Applies the ends of a table to a scene; other ends are unchanged. If there are several rods on
/// one line, the first row is that of the first rod, and so on. Errors (bad_input): a rod that does
/// not exist or has no constrained end, a leg that is not positive, a zero direction where one is
/// prescribed.
Result<void> apply_ends_table(const preset::Points& table, Scene& scene);

// The second ring: rods that continue outside the boundary by a tail without joints. The far end of
// the tail is pinned where the rod has the net's tangent at the first ring, which makes a clamp
// that can be built.

/// Position of the far end of a tail of length l: P + l (1 - k^2 l^2/15) t + (l^2/3) k n, with the
/// net rod's outward unit tangent t and its curvature vector k n at the end P. To leading order in
/// k l a cantilever with a force at its tip has the moment EI k at its root if the deflection of
/// the tip is k l^2/3: at P the rod then has the net's tangent and curvature.
Eigen::Vector3d far_end(const Eigen::Vector3d& end, const Eigen::Vector3d& outwards,
                        const Eigen::Vector3d& curvature, double length);

/// The curvature vector of a net's rod through (u, v), 1/mm: the change of its tangent, by
/// differences, one-sided `inwards` (along the rod, +1 or -1) where the net ends. Errors: those of
/// the net.
Result<Eigen::Vector3d> rod_curvature(const ChebyshevNet& net, Family family,
                                      const Eigen::Vector2d& uv, double inwards);

/// Adds a tail of that length to all pinned ends of a scene on a net. In the flat it continues the
/// rod straight. Errors: those of the net.
Result<void> add_second_ring(double length_mm, Scene& scene);

/// (u, v) on the net of a mesh's nodes without ghosts. Nodes of tails are at their edge point; legs
/// that a design made longer or shorter cover the same piece of the net as before.
Eigen::Matrix2Xd within_boundary(const Footprint& footprint, const RodMesh& mesh);

/// Moves the nodes of tails to the straight lines between their two pins at the end of the motion.
void set_tails(const Scene& scene, const RodMesh& mesh, Eigen::Matrix3Xd& positions);

/// Positions on the scene's net of the nodes of a mesh without ghosts; tails as in set_tails().
/// Errors: those of the net.
Result<Eigen::Matrix3Xd> positions_on_net(const Scene& scene, const RodMesh& mesh);

}  // namespace gridshell
