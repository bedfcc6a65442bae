// Cubic splines: curves through points, and heights over a rectangular grid.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/geometry/calculus.h"

namespace gridshell {

/// Second derivatives at the knots t of cubic splines, one spline per row of `points`, one column
/// per knot; at least 4 knots. End conditions are not-a-knot: the third derivative is continuous at
/// the second and the last but one knot.
Eigen::MatrixXd second_derivatives(const std::vector<double>& t, const Eigen::MatrixXd& points);

/// Cubic spline through points of the plane or of space (one per column), knots by chord length,
/// not-a-knot at its ends: twice continuously differentiable, error of fourth order in the spacing.
class SplineCurve {
 public:
  /// A vector of two or three coordinates without heap memory.
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

/// A spline curve parametrised by arc length: s in [-length/2, length/2] from its middle, mm.
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

/// Height z = h(x, y) through values on a rectangular grid: piecewise bicubic, twice continuously
/// differentiable (splines in x of splines in y, not-a-knot at the edges); error of fourth order in
/// the distance of the grid's points.
class HeightGrid {
 public:
  /// `x`, `y`: rising, mm; `z`: one row per y, one column per x, mm. Errors (bad_input): fewer than
  /// 4 x or y, x or y not rising, a number that is not finite.
  static Result<HeightGrid> through(std::vector<double> x, std::vector<double> y,
                                    Eigen::MatrixXd z);

  double at(double x, double y) const;  ///< the height; NaN outside the grid

 private:
  std::vector<double> x_, y_;
  /// Values and second derivatives at the grid's points.
  Eigen::MatrixXd z_, z_xx_, z_yy_, z_xxyy_;
};

}  // namespace gridshell
