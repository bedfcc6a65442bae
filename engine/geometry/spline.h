// A smooth curve through points, by arc length.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/geometry/calculus.h"

namespace gridshell {

/// Second derivatives at the knots t of cubic splines through values (one row each, a column a
/// knot), not-a-knot: the third derivative is continuous at the second and the last but one of 4 or
/// more.
Eigen::MatrixXd second_derivatives(const std::vector<double>& t, const Eigen::MatrixXd& points);

/// Cubic spline through points of the plane or of space (one per column), knots by chord length,
/// not-a-knot at its ends: twice continuously differentiable, error of fourth order in the spacing.
class SplineCurve {
 public:
  /// of two or three coordinates, without memory of its own on the heap
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
  struct Point {
    Vector position, first, second;  ///< C, dC/dt, d2C/dt2
  };

  /// Errors (bad_input): fewer than four points, a coordinate that is not finite, two equal
  /// neighbours; names the point, counted from 1.
  static Result<SplineCurve> through(const Eigen::MatrixXd& points);

  const std::vector<double>& knots() const { return knots_; }
  Point at(double t) const;  ///< t in [knots().front(), knots().back()]

 private:
  std::vector<double> knots_;
  Eigen::MatrixXd points_, second_;  ///< positions and second derivatives at the knots
};

/// A spline curve at unit speed: s in [-length/2, length/2] from its middle, mm.
class UnitSpeedCurve {
 public:
  explicit UnitSpeedCurve(SplineCurve curve);
  double half_length() const { return half_length_; }
  SplineCurve::Point at(double s) const;  ///< derivatives with respect to s

 private:
  std::shared_ptr<const SplineCurve> curve_;
  std::shared_ptr<const Antiderivative> length_;
  double half_length_ = 0;
};

// A height over a rectangular grid, by a spline.

/// z = h(x, y) through its values on a grid: piecewise bicubic, twice continuously differentiable
/// (splines in x of splines in y, not-a-knot at the edges); error of fourth order in the distance
/// of its points. No value outside the edges.
class HeightGrid {
 public:
  /// `z`: rows x columns, mm. Errors (bad_input): fewer than 4 x or y, not rising, not finite.
  static Result<HeightGrid> through(std::vector<double> x, std::vector<double> y,
                                    Eigen::MatrixXd z);

  double at(double x, double y) const;  ///< not a number outside the edges

 private:
  std::vector<double> x_, y_;
  Eigen::MatrixXd z_, z_xx_, z_yy_, z_xxyy_;  ///< at the points: values and second derivatives
};

}  // namespace gridshell
