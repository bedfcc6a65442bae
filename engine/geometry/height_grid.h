// A height over a rectangular grid, by a spline.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/core/result.h"

namespace gridshell {

/// z = h(x, y) through its values on a grid: piecewise bicubic, twice continuously differentiable
/// (splines in x of splines in y, not-a-knot at the edges); error of fourth order in the distance
/// of its points. No value beyond the edges.
class HeightGrid {
 public:
  /// `z`: rows x columns, mm. Errors (bad_input): fewer than 4 x or y, not rising, not finite.
  static Result<HeightGrid> through(std::vector<double> x, std::vector<double> y,
                                    Eigen::MatrixXd z);

  double at(double x, double y) const;  ///< not a number beyond the edges

 private:
  std::vector<double> x_, y_;
  Eigen::MatrixXd z_, z_xx_, z_yy_, z_xxyy_;  ///< at the points: values and second derivatives
};

}  // namespace gridshell
