// The tops of joints in a cloud of points: what lies together is one of them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/core/result.h"

namespace gridshell {

/// What a cloud comes to.
struct Clusters {
  Eigen::Matrix3Xd tops;    ///< middles of the discs, mm
  std::vector<int> points;  ///< of each
  int specks = 0;           ///< clusters of too few points
  int others = 0;           ///< clusters wider than a joint, or two things that touch
};

/// Points that lie nearer to one another than a third of `diameter_mm` are one cluster (further
/// apart than 1.2 diameters never). A cluster with less than a quarter of the points of the cluster
/// that the median point is in is a speck; one that reaches further than a diameter from its
/// middle, or with a twentieth of its points beyond 1.25 radii, is no joint. The middle of a top is
/// that of a disc of the diameter in the points' plane which they overhang least, since their mean
/// depends on how evenly a scanner sees it; along the normal it is their mean. Errors (bad_input):
/// points so far apart that they cannot be one shell.
Result<Clusters> cluster_tops(const Eigen::Matrix3Xd& cloud, double diameter_mm);

}  // namespace gridshell
