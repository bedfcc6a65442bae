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

/// Gives a scene other ends: legs of other lengths start from other edge points of the flat, far
/// ends of tails go along with their edge points.
void put_ends(const ShellEnds& ends, Scene& scene);

/// The rows of `[ends] table` in the order of the ends: family (0: u), index of the rod, end (0:
/// begin), x, y, z, leg, tx, ty, tz. Free ends have none.
preset::Points table_of(const Scene& scene, const ShellEnds& ends);

/// The rows of `[rod] table` in the order of the rods: family (0: u), index of the rod, diameter.
preset::Points rod_table_of(const Scene& scene, const ShellEnds& ends);

/// Gives a scene the ends of a table; those that it does not name stay. Of several rods on one line
/// the first row is the first rod's, and so on. Errors (bad_input): a rod that is not there or not
/// held, a leg that is not positive, a direction of no length where one is held.
Result<void> put_table(const preset::Points& table, Scene& scene);

}  // namespace gridshell
