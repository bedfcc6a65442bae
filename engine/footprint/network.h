// A footprint from any network of rods, in a plane or in space: straight ones in all directions,
// polylines and rings.
#pragma once

#include <Eigen/Core>
#include <map>
#include <set>
#include <vector>

#include "engine/core/result.h"
#include "engine/footprint/footprint.h"

namespace gridshell {

/// Rods as lists of points. Rods that name the same point are joined there.
struct RodNetwork {
  Eigen::Matrix3Xd points;                   ///< mm; all of height 0: in the plane
  std::vector<std::vector<int>> rods;        ///< numbers of points; a ring ends with its first one
  std::vector<char> supported;               ///< of each point: what it is on is fixed there
  std::vector<char> free;                    ///< of each point: rods' ends there are not fixed
  std::set<int> joined{};                    ///< points at which rods' ends are joined
  std::map<int, Eigen::Vector3d> springs{};  ///< of supports on springs: along x, y, z, N/mm
  RodEnd hold = RodEnd::pinned;              ///< of ends that have supports of their own
  std::map<int, RodEnd> holds{};             ///< of single ones: begin of rod r at 2 r
};

/// The footprint, and which points of the network its ends and fixed joints are.
struct NetworkFootprint {
  Footprint footprint;
  std::vector<int> ends;    ///< of each end: begin of rod r at 2 r
  std::vector<int> joints;  ///< of each of its fixed_joints
};

/// What points are:
///   a rod's inner point that is on another rod too, or supported: a joint (held, if supported);
///   an inner point of a rod that is not straight: a joint of this rod alone;
/// a point where rods only end: there each has an edge point of its own, fixed as `hold` gives;
///   the same, but free or on a spring: with one rod its end, with several a joint of their ends;
///   the same, but named as joined, of several rods: a joint of their ends (held, if supported);
///   where rods end at an inner point of another: they are joined to that joint.
/// Rods are naturally straight and as long as their polyline. Rods that cross without a common
/// point pass one another. Where all rods are in the plane and of a square grid about the origin,
/// rods and cells are named as its. Joints are named by their points: (number, 0).
/// Errors (bad_input), naming rods ("rods[3]") and points: a rod of one point, of no length, twice
/// through a point, twice along a stretch, or joined to nothing; a free point that is no end; a
/// constraint of an end without a support of its own; a piece that is not fixed at three points off
/// a line, prescribed directions counting as points further out, or by springs along too few
/// directions, as it would move or turn freely.
Result<NetworkFootprint> network_footprint(const RodNetwork& network);

/// Names rods and cells as those of a square grid about the origin, u-rods first, if they all are;
/// else changes nothing. Joints keep the names of their points.
void name_as_grid(NetworkFootprint& network, Placement placement);

}  // namespace gridshell
