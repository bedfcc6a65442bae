// Integrated Gauss curvature of the cells from the rods' crossing angles [Baek 2018, eq. 2].
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "engine/footprint/mesh.h"

namespace gridshell {

/// Unit tangents of the two rods at every joint: along +u of its u-rod, along +v of its v-rod (3 x
/// joints); where rods are of no grid of the first two that cross there, u x v upwards in the flat,
/// and zero where there are not two. t is proportional to t1 l2 + t2 l1, with t1, t2 the unit
/// tangents of the edges before and after the joint and l1, l2 their lengths: the derivative of a
/// quadratic through three nodes, second order in edge length.
struct JointTangents {
  Eigen::Matrix3Xd u, v;

  /// t_u x t_v, a unit vector.
  Eigen::Vector3d normal(Eigen::Index joint) const;
};

JointTangents joint_tangents(const Footprint& footprint, const RodMesh& mesh,
                             const Eigen::Matrix3Xd& x);

/// K of every complete cell = 2 pi - sum of its four interior angles, each between the tangents of
/// the rods at the joint (rad). [Hazzidakis 1880; Baek 2018, eq. 2]
Eigen::VectorXd cell_curvature(const Footprint& footprint, const JointTangents& tangents);

// Curvature of the cells along an axis, in bins [Baek 2018, Fig. 4D].

/// Bins of equal width over [-1, 1] of x/L, and what falls into each.
struct CurvatureBins {
  Eigen::VectorXd low, high;  ///< ends of each bin in x/L
  Eigen::VectorXi cells;      ///< how many cells
  Eigen::VectorXd mean;       ///< of K over the bin's cells, rad; NaN where there is none
  Eigen::VectorXd deviation;  ///< sqrt(mean of (K - mean)^2), rad: how unlike the cells are
};

/// The paper's five bins are 0.4 wide. A cell belongs to the bin of its centroid's x/L; one beyond
/// the ends to the bin there. `x_over_L` and `K`: one a cell.
CurvatureBins curvature_bins(const Eigen::VectorXd& x_over_L, const Eigen::VectorXd& K,
                             int bins = 5);

}  // namespace gridshell
