#include "engine/geometry/spline.h"

#include <array>
#include <cmath>
#include <limits>

#include "engine/core/algorithms.h"
#include "engine/core/dense.h"

namespace gridshell {

/// Solves the tridiagonal equations of continuous first derivatives at the inner knots.
Eigen::MatrixXd second_derivatives(const std::vector<double>& t, const Eigen::MatrixXd& points) {
  const Eigen::Index n = points.cols();
  std::vector<double> h(n - 1);
  for (Eigen::Index k = 0; k + 1 < n; ++k) h[k] = t[k + 1] - t[k];
  Eigen::VectorXd diagonal(n), upper(n), lower(n);
  Eigen::MatrixXd m(points.rows(), n);
  for (Eigen::Index k = 1; k + 1 < n; ++k) {
    lower[k] = h[k - 1];
    diagonal[k] = 2 * (h[k - 1] + h[k]);
    upper[k] = h[k];
    m.col(k) = 6 * ((points.col(k + 1) - points.col(k)) / h[k] -
                    (points.col(k) - points.col(k - 1)) / h[k - 1]);
  }
  // m_0 = m_1 (1 + h_0/h_1) - m_2 h_0/h_1, and likewise at the other end
  const double first = h[0] / h[1], last = h[n - 2] / h[n - 3];
  diagonal[1] += lower[1] * (1 + first);
  upper[1] -= lower[1] * first;
  diagonal[n - 2] += upper[n - 2] * (1 + last);
  lower[n - 2] -= upper[n - 2] * last;
  solve_tridiagonal(lower.segment(1, n - 2), diagonal.segment(1, n - 2), upper.segment(1, n - 2),
                    m.middleCols(1, n - 2));
  m.col(0) = m.col(1) * (1 + first) - m.col(2) * first;
  m.col(n - 1) = m.col(n - 2) * (1 + last) - m.col(n - 3) * last;
  return m;
}

Result<SplineCurve> SplineCurve::through(const Eigen::MatrixXd& points) {
  const Eigen::Index n = points.cols();
  if (n < 4) return invalid("a curve: got {} points, expected at least 4", n);
  for (Eigen::Index k = 0; k < n; ++k)
    if (!points.col(k).allFinite()) return invalid("point {} of the curve is not finite", k + 1);
  SplineCurve curve;
  curve.points_ = points;
  curve.knots_.resize(n, 0.0);
  for (Eigen::Index k = 1; k < n; ++k) {
    const double chord = (points.col(k) - points.col(k - 1)).norm();
    if (chord == 0) return invalid("points {} and {} of the curve are the same", k, k + 1);
    curve.knots_[k] = curve.knots_[k - 1] + chord;
  }
  curve.second_ = second_derivatives(curve.knots_, points);
  return curve;
}

SplineCurve::Point SplineCurve::at(double t) const {
  const auto k = Eigen::Index(piece_at(knots_, t));
  const double h = knots_[k + 1] - knots_[k], b = (t - knots_[k]) / h, a = 1 - b;
  const auto p0 = points_.col(k), p1 = points_.col(k + 1);
  const auto m0 = second_.col(k), m1 = second_.col(k + 1);
  return {a * p0 + b * p1 + h * h / 6 * ((a * a * a - a) * m0 + (b * b * b - b) * m1),
          (p1 - p0) / h + h / 6 * ((1 - 3 * a * a) * m0 + (3 * b * b - 1) * m1), a * m0 + b * m1};
}

UnitSpeedCurve::UnitSpeedCurve(SplineCurve curve)
    : curve_(std::make_shared<const SplineCurve>(std::move(curve))) {
  const auto speed = [curve = curve_](double t) { return curve->at(t).first.norm(); };
  const std::vector<double>& knots = curve_->knots();
  const Antiderivative from_start(speed, knots, knots.front());
  half_length_ = from_start(knots.back()) / 2;
  length_ = std::make_shared<const Antiderivative>(speed, knots, from_start.inverse(half_length_));
}

SplineCurve::Point UnitSpeedCurve::at(double s) const {
  SplineCurve::Point point = curve_->at(length_->inverse(s));
  const double speed = point.first.norm();
  point.first /= speed;
  // C_ss = (C_tt - (C_tt . C_s) C_s) / |C_t|^2
  point.second -= point.second.dot(point.first) * point.first;
  point.second /= speed * speed;
  return point;
}

namespace {

/// The interval between knots that contains a value, and the weights of the values and second
/// derivatives at its two knots in the spline's value.
struct Cell {
  Eigen::Index at;
  std::array<double, 2> value, second;

  Cell(const std::vector<double>& knots, double t) {
    const std::size_t k = piece_at(knots, t);
    at = Eigen::Index(k);
    const double h = knots[k + 1] - knots[k], b = (t - knots[k]) / h, a = 1 - b;
    value = {a, b};
    second = {h * h / 6 * (a * a * a - a), h * h / 6 * (b * b * b - b)};
  }
};

bool rises(const std::vector<double>& values) {
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(values[k] > values[k - 1]) || !std::isfinite(values[k] - values[0])) return false;
  return values.size() >= 4;
}

}  // namespace

Result<HeightGrid> HeightGrid::through(std::vector<double> x, std::vector<double> y,
                                       Eigen::MatrixXd z) {
  if (!rises(x) || !rises(y))
    return invalid("x and y of a grid of heights: expected 4 or more rising numbers");
  if (z.rows() != Eigen::Index(y.size()) || z.cols() != Eigen::Index(x.size()) || !z.allFinite())
    return invalid("a grid of heights: got a height that is not finite");
  HeightGrid grid;
  grid.z_xx_ = second_derivatives(x, z);
  grid.z_yy_ = second_derivatives(y, z.transpose()).transpose();
  grid.z_xxyy_ = second_derivatives(y, grid.z_xx_.transpose()).transpose();
  grid.x_ = std::move(x), grid.y_ = std::move(y), grid.z_ = std::move(z);
  return grid;
}

double HeightGrid::at(double x, double y) const {
  if (!(x >= x_.front() && x <= x_.back() && y >= y_.front() && y <= y_.back()))
    return std::numeric_limits<double>::quiet_NaN();
  const Cell in_x(x_, x), in_y(y_, y);
  double sum = 0;
  for (std::size_t b = 0; b < 2; ++b)
    for (std::size_t a = 0; a < 2; ++a) {
      const Eigen::Index i = in_x.at + Eigen::Index(a), j = in_y.at + Eigen::Index(b);
      sum += in_y.value[b] * (in_x.value[a] * z_(j, i) + in_x.second[a] * z_xx_(j, i)) +
             in_y.second[b] * (in_x.value[a] * z_yy_(j, i) + in_x.second[a] * z_xxyy_(j, i));
    }
  return sum;
}

}  // namespace gridshell
