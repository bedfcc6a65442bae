// Closed plane curves: original and actuated boundaries that a user gives.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "engine/core/choices.h"
#include "engine/core/result.h"
#include "engine/geometry/calculus.h"

namespace gridshell {

/// A closed curve without crossings, counter-clockwise, mm. Its parameter t goes from 0 to last()
/// once around.
class ClosedCurve {
 public:
  struct Point {
    Eigen::Vector2d position, first;  ///< C(t), dC/dt
  };

  /// An ellipse or a circle. The errors of all these functions are bad_input with the wrong value.
  static Result<ClosedCurve> ellipse(double half_x_mm, double half_y_mm);
  /// |x/a|^n + |y/b|^n = 1, n >= 1 (2: an ellipse); t is the polar angle.
  static Result<ClosedCurve> superellipse(double half_x_mm, double half_y_mm, double exponent);
  /// Straight lines between points, 2 x n, n >= 3, in either direction; the first point may be
  /// repeated at the end.
  static Result<ClosedCurve> polygon(const Eigen::Matrix2Xd& points);
  /// Periodic cubic spline through points as those of polygon(), with knots by chord length.
  static Result<ClosedCurve> spline(const Eigen::Matrix2Xd& points);

  double last() const { return breaks_.back(); }
  /// Parameters of corners and knots, and both ends of the range of t.
  const std::vector<double>& breaks() const { return breaks_; }
  Point at(double t) const { return at_(t); }
  double length() const { return (*length_)(last()); }
  double arc_length(double t) const { return (*length_)(t); }  ///< length from t = 0
  double at_arc_length(double s) const;  ///< t at the arc length s modulo the total length

  /// Every t at which coordinate `axis` (0: x, 1: y) equals c, to round-off. A stretch of the curve
  /// on the line counts as on its positive side, so the number of crossings is even.
  std::vector<double> crossings(int axis, double c) const;

  /// t of the point of the curve that is nearest to `point`.
  double nearest(const Eigen::Vector2d& point) const;

 private:
  static Result<ClosedCurve> make(std::function<Point(double)> at, std::vector<double> breaks);
  /// `breaks` with points in between, so that the curve turns little from one to the next.
  std::vector<double> samples() const;

  std::function<Point(double)> at_;
  std::vector<double> breaks_;
  std::shared_ptr<const Antiderivative> length_;
};

/// Maps points of the original boundary to the actuated one.
class BoundaryMap {
 public:
  /// Errors (bad_input), with the boundary and the position: the origin is not inside; a ray from
  /// the origin meets a boundary more than once (for `angle` any ray, else the positive x-axis).
  static Result<BoundaryMap> make(ClosedCurve original, ClosedCurve actuated, Correspondence how);

  /// The actuated position of a point on the original boundary.
  Eigen::Vector2d operator()(const Eigen::Vector2d& on_original) const;

 private:
  ClosedCurve original_, actuated_;
  Correspondence how_{};
  double start_original_ = 0, start_actuated_ = 0;  ///< arc lengths at the positive x-axis
};

/// Indices of the corners of the convex hull of points, counter-clockwise.
std::vector<int> hull_of(const Eigen::Matrix2Xd& points);
/// Indices of the points on the convex hull, with those on its edges; each position once.
std::vector<int> rim_of(const Eigen::Matrix2Xd& points);

}  // namespace gridshell
