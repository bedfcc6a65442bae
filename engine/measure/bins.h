// Curvature of the cells along an axis, in bins [Baek 2018, Fig. 4D].
#pragma once

#include <Eigen/Core>

namespace gridshell {

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
