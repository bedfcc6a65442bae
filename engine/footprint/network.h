// Footprint of any network of rods, in a plane or in space: straight rods in all directions,
// polylines and rings.
#pragma once

#include <Eigen/Core>
#include <map>
#include <set>
#include <vector>

#include "engine/core/result.h"
#include "engine/footprint/footprint.h"

namespace gridshell {

/// Rods as lists of points. Rods with a common point are joined there.
struct RodNetwork {
  Eigen::Matrix3Xd points;             ///< mm; in the plane if all heights are 0
  std::vector<std::vector<int>> rods;  ///< numbers of points; a ring ends with its first one
  std::vector<char> supported;  ///< for each point: whether its joint or ends are fixed there
  std::vector<char> free;       ///< for each point: whether rods' ends there are not fixed
  std::set<int> joined{};       ///< points at which the ends of several rods are one joint
  /// For each point whose support is on a spring: the stiffness along x, y, z, N/mm.
  std::map<int, Eigen::Vector3d> springs{};
  RodEnd end_constraint = RodEnd::pinned;  ///< what a support prescribes at a rod's end
  /// What the support of a single end prescribes instead; rod r starts at 2r and ends at 2r + 1.
  std::map<int, RodEnd> end_constraints{};
};

/// A footprint, with the point of the network of each end and of each fixed joint.
struct NetworkFootprint {
  Footprint footprint;
  std::vector<int> ends;    ///< point of each end; rod r starts at 2r, ends at 2r + 1
  std::vector<int> joints;  ///< point of each of footprint.fixed_joints
};

/// The footprint of a network. The rods through a point decide what it becomes:
///   - inner point of a rod, also on another rod or supported: a joint, fixed if supported;
///   - inner point of one rod that is not straight there: a joint of this rod alone;
///   - end of rods only: an edge point for each of them, fixed as `end_constraint` or
///   `end_constraints` says;
///   - end of rods only, free or on a spring: the end of a rod, or a joint of several ends;
///   - end of several rods, listed in `joined`: a joint of their ends, fixed if supported;
///   - end of a rod at an inner point of another: the rod is joined to that joint.
/// Rods are naturally straight and as long as their polyline. Rods that cross without a common
/// point are not connected. A joint has the indices (number of its point, 0). If all rods are in
/// the plane and on a square grid about the origin, rods and cells have the indices of that grid.
/// Errors (bad_input), naming rods ("rods[3]") and points: a rod with a single point, without
/// length, twice through a point or along the same stretch, or connected to nothing; a free point
/// that is no end; a prescribed direction at an end without a support of its own; a connected part
/// that could move or turn freely. A part is fixed by three points that are not on one line (a
/// prescribed direction counts as one more point) or by springs along enough directions.
Result<NetworkFootprint> network_footprint(const RodNetwork& network);

/// Gives rods and cells the families and indices of a square grid about the origin, u-rods first,
/// if all rods are on that grid; otherwise changes nothing. The indices of joints are not changed.
void name_as_grid(NetworkFootprint& network, Placement placement);

}  // namespace gridshell
