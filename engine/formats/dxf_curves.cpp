#include "engine/formats/dxf_curves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/dense.h"

namespace gridshell::preset {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int most_pieces = 2000;  // in one span

using Curve = std::function<Eigen::Vector3d(double)>;

/// Angle by which the direction of a piece of a curve changes, estimated from some of its points.
double turn_of(const Curve& at, double from, double to) {
  constexpr int seen = 16;
  double turn = 0;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  for (int k = 1; k <= seen; ++k) {
    const double a = from + (to - from) * (k - 1) / seen, b = from + (to - from) * k / seen;
    const Eigen::Vector3d step = at(b) - at(a);
    if (step.norm() > 0 && last.norm() > 0) turn += angle_between(last, step);
    if (step.norm() > 0) last = step;
  }
  return turn * seen / (seen - 1);
}

void append_span(const Curve& at, double from, double to, std::vector<Eigen::Vector3d>& points) {
  const auto more = sampled_curve(at, from, to, pieces_of_turn(turn_of(at, from, to)));
  points.insert(points.end(), more.begin(), more.end());
}

/// De Boor's algorithm in homogeneous coordinates.
Eigen::Vector3d b_spline_at(const SplineData& spline, std::size_t span, double t) {
  const auto p = std::size_t(spline.degree);
  std::vector<Eigen::Vector4d> d;
  for (std::size_t j = 0; j <= p; ++j) {
    const std::size_t k = span - p + j;
    const double weight = spline.weights.empty() ? 1 : spline.weights[k];
    d.emplace_back();
    d.back() << weight * spline.controls[k], weight;
  }
  for (std::size_t r = 1; r <= p; ++r)
    for (std::size_t j = p; j >= r; --j) {
      const double low = spline.knots[j + span - p], high = spline.knots[j + 1 + span - r];
      const double fraction = high > low ? (t - low) / (high - low) : 0;
      d[j] = (1 - fraction) * d[j - 1] + fraction * d[j];
    }
  return d[p].head<3>() / d[p][3];
}

std::vector<Eigen::Vector3d> b_spline_points(const SplineData& spline) {
  const auto p = std::size_t(spline.degree), n = spline.controls.size();
  const bool fits = spline.degree >= 1 && spline.degree <= 25 && n > p &&
                    spline.knots.size() == n + p + 1 &&
                    (spline.weights.empty() || spline.weights.size() == n) &&
                    std::ranges::is_sorted(spline.knots) &&
                    std::ranges::all_of(spline.weights, [](double w) { return w > 0; });
  if (!fits || !(spline.knots[p] < spline.knots[n])) return {};
  std::vector<Eigen::Vector3d> points;
  for (std::size_t span = p; span < n; ++span) {
    const double from = spline.knots[span], to = spline.knots[span + 1];
    if (!(from < to)) continue;
    const auto at = [&](double t) { return b_spline_at(spline, span, t); };
    if (points.empty()) points.push_back(at(from));
    append_span(at, from, to, points);
  }
  return points;
}

/// Second derivatives, 3 x n, of the cubic spline through points at t.
Eigen::MatrixXd curvatures(const SplineData& spline, const std::vector<double>& t) {
  const auto& f = spline.fits;
  const auto n = Eigen::Index(f.size());
  Eigen::VectorXd below = Eigen::VectorXd::Zero(n), on = Eigen::VectorXd::Ones(n), above = below;
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(3, n);
  const auto slope = [&](Eigen::Index k) -> Eigen::Vector3d {
    return (f[k + 1] - f[k]) / (t[k + 1] - t[k]);
  };
  for (Eigen::Index k = 1; k + 1 < n; ++k) {
    below[k] = t[k] - t[k - 1];
    above[k] = t[k + 1] - t[k];
    on[k] = 2 * (below[k] + above[k]);
    m.col(k) = 6 * (slope(k) - slope(k - 1));
  }
  if (spline.tangents.size() == 2) {
    above[0] = t[1] - t[0];
    on[0] = 2 * above[0];
    m.col(0) = 6 * (slope(0) - spline.tangents[0]);
    below[n - 1] = t[n - 1] - t[n - 2];
    on[n - 1] = 2 * below[n - 1];
    m.col(n - 1) = 6 * (spline.tangents[1] - slope(n - 2));
  }
  solve_tridiagonal(below, on, above, m);
  return m;
}

std::vector<Eigen::Vector3d> fitted_points(SplineData spline) {
  auto& f = spline.fits;
  f.erase(std::unique(f.begin(), f.end()), f.end());
  if (f.size() < 2) return {};
  std::vector<double> t{0};
  for (std::size_t k = 1; k < f.size(); ++k) t.push_back(t.back() + (f[k] - f[k - 1]).norm());
  for (Eigen::Vector3d& tangent : spline.tangents) tangent.normalize();
  const auto m = curvatures(spline, t);
  std::vector<Eigen::Vector3d> points{f[0]};
  for (std::size_t k = 0; k + 1 < f.size(); ++k) {
    const double h = t[k + 1] - t[k];
    const auto at = [&](double s) -> Eigen::Vector3d {
      const double b = (s - t[k]) / h, a = 1 - b;
      return a * f[k] + b * f[k + 1] +
             ((a * a * a - a) * m.col(k) + (b * b * b - b) * m.col(k + 1)) * h * h / 6;
    };
    append_span(at, t[k], t[k + 1], points);
  }
  return points;
}

}  // namespace

std::vector<Eigen::Vector3d> sampled_curve(const Curve& at, double from, double to, int pieces) {
  std::vector<Eigen::Vector3d> points;
  for (int k = 1; k <= pieces; ++k) points.push_back(at(from + (to - from) * k / pieces));
  return points;
}

int pieces_of_turn(double angle) {
  return std::clamp(int(std::ceil(std::min(angle / degree - 1e-9, 1e6))), 1, most_pieces);
}

std::vector<Eigen::Vector3d> bulge_points(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          double bulge) {
  const Eigen::Vector3d chord = b - a, left(-chord.y(), chord.x(), 0);
  const Eigen::Vector3d centre = a + 0.5 * chord + left * (1 - bulge * bulge) / (4 * bulge);
  const Eigen::Vector3d arm = a - centre, across(-arm.y(), arm.x(), 0);
  const double angle = 4 * std::atan(bulge);
  auto points = sampled_curve(
      [&](double turn) -> Eigen::Vector3d {
        return centre + std::cos(turn) * arm + std::sin(turn) * across;
      },
      0, angle, pieces_of_turn(std::abs(angle)));
  points.back() = b;
  return points;
}

std::vector<Eigen::Vector3d> spline_points(const SplineData& spline) {
  return spline.controls.empty() ? fitted_points(spline) : b_spline_points(spline);
}

}  // namespace gridshell::preset
