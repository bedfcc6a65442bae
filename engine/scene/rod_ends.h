// What a designer may change of a shell: where its rods' ends are held, along which direction, how
// long its legs are and how thick the rods between.
#pragma once

#include <Eigen/Core>

#include "engine/core/result.h"
#include "engine/scene/scene.h"

namespace gridshell {

/// The ends of all rods where the scene's motion ends: column or entry 2r is the begin, 2r + 1 the
/// end of rod r.
struct ShellEnds {
  Eigen::Matrix3Xd at;         ///< edge points, mm
  Eigen::VectorXd leg;         ///< from the edge point to the joint next to it, along the rod, mm
  Eigen::Matrix3Xd direction;  ///< unit, along the rod as positions grow; zero where none is held
  Eigen::VectorXd diameter;    ///< of rod r, mm; rectangular rods keep their sections
};

ShellEnds ends_of(const Scene& scene);

/// The rows of `[ends] table` in the order of the ends: family (0: u), index of the rod, end (0:
/// begin), x, y, z, leg, tx, ty, tz. Free ends have none.
preset::Points table_of(const Scene& scene, const ShellEnds& ends);

/// The rows of `[rod] table` in the order of the rods: family (0: u), index of the rod, diameter.
preset::Points rod_table_of(const Scene& scene, const ShellEnds& ends);

/// Gives a scene the ends of a table; those that it does not name stay. Of several rods on one line
/// the first row is the first rod's, and so on. Errors (bad_input): a rod that is not there or not
/// held, a leg that is not positive, a direction of no length where one is held.
Result<void> apply_ends_table(const preset::Points& table, Scene& scene);

// The second ring: rods that go on beyond the boundary by a tail without joints, whose far end is
// pinned where it keeps the net's tangent at the first ring. A clamp that can be built.

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

/// Where the nodes of a mesh, but for ghosts, are on the scene's net, tails as place_tails() has
/// them. Errors: those of the net.
Result<Eigen::Matrix3Xd> places_on_net(const Scene& scene, const RodMesh& mesh);

}  // namespace gridshell
