// Curves of drawings as points: arcs, ellipses and splines.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace gridshell::preset {

/// Points of a curve behind its first: at `pieces` equal steps of its parameter.
std::vector<Eigen::Vector3d> sampled_curve(const std::function<Eigen::Vector3d(double t)>& at,
                                           double from, double to, int pieces);

/// As many pieces as a turn by an angle (rad) has degrees, at least one.
int pieces_of_turn(double angle);

/// Points behind `a` up to `b` of the arc whose bulge is tan(angle/4), left of it being positive;
/// in the plane of their x and y.
std::vector<Eigen::Vector3d> bulge_points(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          double bulge);

/// A spline as DXF has it.
struct SplineData {
  int degree = 3;
  std::vector<double> knots, weights;     ///< no weights: all 1
  std::vector<Eigen::Vector3d> controls;  ///< or none: through `fits`
  std::vector<Eigen::Vector3d> fits;      ///< points that it goes through
  std::vector<Eigen::Vector3d> tangents;  ///< at its first and last fit point; or none
};

/// Points of a spline, at most one degree of its direction apart; for fit points alone the cubic
/// spline with continuous curvature over their chord lengths, with straight ends where tangents are
/// missing. Empty: its numbers of knots, weights and points are inconsistent.
std::vector<Eigen::Vector3d> spline_points(const SplineData& spline);

}  // namespace gridshell::preset
