// The footprint of a gridshell: a square grid of straight rods cut along an original boundary
// [Baek 2018, 'Anatomy and Actuation'].
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/footprint/domain.h"

namespace gridshell {

/// Where the grid lines lie: at (i + 1/2) d, or at i d so that one rod of each family is an axis.
enum class Placement { half, on_axis };

/// A joint: the crossing of the u-rod with index j and the v-rod with index i.
struct FootprintJoint {
  int i = 0, j = 0;
  double u = 0, v = 0;  ///< mm
};

/// A complete cell: joints (i,j), (i+1,j), (i+1,j+1), (i,j+1), all four rods between them present.
struct FootprintCell {
  int i = 0, j = 0;
  std::array<int, 4> joints{};
};

/// What holds a rod's end: nothing, its position, its position and direction, or its spin too.
enum class RodEnd { free, pinned, tangent, clamped };

inline bool holds_direction(RodEnd end) { return end == RodEnd::tangent || end == RodEnd::clamped; }

/// One rod from edge point to edge point. Positions run along the rod: u on a u-rod, v on a v-rod.
struct FootprintRod {
  Family family = Family::u;
  int index = 0;            ///< j of a u-rod, i of a v-rod
  double line = 0;          ///< its v (u-rod) or u (v-rod), mm
  Interval span;            ///< edge points
  std::vector<int> joints;  ///< in order along the rod, at least one
  RodEnd begin = RodEnd::pinned, end = RodEnd::pinned;
  double tail_begin = 0, tail_end = 0;  ///< beyond the edge point to a second pin, mm; 0: none
  /// of a designed shell: what its legs are longer than those that end on the net's boundary, mm
  double longer_begin = 0, longer_end = 0;

  bool has_tails() const { return tail_begin > 0 || tail_end > 0; }
};

/// All rods, joints and complete cells inside an original boundary. Lengths in mm.
struct Footprint {
  double spacing = 0;
  Placement placement = Placement::half;
  std::vector<FootprintJoint> joints;
  std::vector<FootprintRod> rods;
  std::vector<FootprintCell> cells;

  /// shortest and longest leg: from an edge point to the joint next to it
  double shortest_leg() const;
  double longest_leg() const;
};

/// The rods' lines of one family that a placement puts within `reach` of the origin.
double line_of(Placement placement, int index, double spacing);

/// Cuts the square grid along the boundary of `domain`. Rods of both families at
/// line_of(placement, k, d) for every k whose line meets the domain.
/// Errors (bad_input): a rod without a joint; no rods at all; too many joints (above 1e6).
Result<Footprint> cut_footprint(const Domain& domain, double spacing, Placement placement);

/// The paper's circle: n rods a direction in a disk of radius R_o. Errors (bad_input), with
/// numbers: n < 2, placement that cannot give n rods (half needs n even, on_axis n odd), longest
/// leg L_d = R_o/d - (n-1)/2 <= 0, a boundary that would hold more than n rods (L_d > 1 is allowed:
/// the legs are then longer than a cell and the rods beyond are left out), a rod without a joint.
Result<Footprint> circular_footprint(double radius, int rods, double spacing, Placement placement);

}  // namespace gridshell
