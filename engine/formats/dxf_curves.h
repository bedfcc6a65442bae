// Curves of drawings as points: arcs, ellipses and splines.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace gridshell::preset {

/// Points of a curve at `pieces` equal steps of its parameter, without the point at `from`.
std::vector<Eigen::Vector3d> sampled_curve(const std::function<Eigen::Vector3d(double t)>& at,
                                           double from, double to, int pieces);

/// Number of pieces for a turn by an angle (rad): one per degree, at least one.
int pieces_of_turn(double angle);

/// Points of an arc after `a` up to `b`, in the plane of x and y. `bulge` is tan(angle/4); if it is
/// above 0 the arc turns left.
std::vector<Eigen::Vector3d> bulge_points(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          double bulge);

/// A spline as DXF defines it.
struct SplineData {
  int degree = 3;
  std::vector<double> knots, weights;     ///< weights may be empty: all are 1
  std::vector<Eigen::Vector3d> controls;  ///< control points; empty: the spline goes through `fits`
  std::vector<Eigen::Vector3d> fits;      ///< points that it goes through
  /// Tangents at its first and last fit point; may be empty.
  std::vector<Eigen::Vector3d> tangents;
};

/// Points of a spline; its direction changes by at most one degree between two points. Fit points
/// without control points give the cubic spline with continuous curvature over their chord lengths,
/// with zero curvature at the ends if there are no tangents. Empty if the numbers of knots, weights
/// and points are inconsistent.
std::vector<Eigen::Vector3d> spline_points(const SplineData& spline);

}  // namespace gridshell::preset
