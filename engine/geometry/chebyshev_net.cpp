#include "engine/geometry/chebyshev_net.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/try.h"

namespace gridshell {

Eigen::Vector3d NetPoint::normal() const { return tangent_u.cross(tangent_v).normalized(); }

Result<Eigen::Matrix3Xd> points_on(const ChebyshevNet& net, const Eigen::Matrix2Xd& uv) {
  Eigen::Matrix3Xd points(3, uv.cols());
  for (Eigen::Index k = 0; k < uv.cols(); ++k) {
    TRY(point, net.at(uv(0, k), uv(1, k)));
    points.col(k) = point->position;
  }
  return points;
}

namespace {

// the series about z = 0 converges for |z| < 2.95; with the steps of longest_step() the remainder
// is below 1e-17
constexpr int order = 36;
using Series = std::array<double, order + 1>;

/// Taylor coefficients a of f along z = z0 + k t, t in [0, 1], from f and df = df/dz at z0:
/// z0 (n+2)(n+1) a_{n+2} + k (n+1)^2 a_{n+1} = -k^2 s_n, where s are the coefficients of sin f.
Series shear_series(double z0, double k, double f, double df) {
  Series a{}, sine{}, cosine{};
  a[0] = f;
  a[1] = z0 == 0 ? -k * std::sin(f) : k * df;
  sine[0] = std::sin(f);
  cosine[0] = std::cos(f);
  for (int n = 0; n + 1 < order; ++n) {
    if (n > 0) {
      for (int j = 1; j <= n; ++j) {
        sine[n] += j * a[j] * cosine[n - j] / n;
        cosine[n] -= j * a[j] * sine[n - j] / n;
      }
    }
    // at the pole (z0 = 0) the recurrence has one term less
    if (z0 == 0 && n > 0) a[n + 1] = -k * sine[n] / ((n + 1.0) * (n + 1.0));
    if (z0 != 0)
      a[n + 2] = -k * (k * sine[n] + (n + 1.0) * (n + 1.0) * a[n + 1]) / (z0 * (n + 2) * (n + 1));
  }
  return a;
}

double sum(const Series& a) {
  double total = 0;
  for (int n = order; n >= 0; --n) total += a[n];
  return total;
}

/// Sum of n a_n: k df/dz at the end of the step.
double sum_derivative(const Series& a) {
  double total = 0;
  for (int n = order; n >= 1; --n) total += n * a[n];
  return total;
}

/// State of the rod v = const on the unit sphere at position u.
struct Rod {
  double u = 0, f = M_PI_2, df = -1;
  Eigen::Matrix3d frame;  ///< columns C, T, N
};

/// One Taylor step of length h: C' = h T, T' = -h C + q N, N' = -q T with q = -df/dt.
void advance(Rod& rod, double v, double h) {
  const Series a = shear_series(rod.u * v, h * v, rod.f, rod.df);
  Eigen::Matrix<double, 3, order + 1> c, t, n;
  c.col(0) = rod.frame.col(0);
  t.col(0) = rod.frame.col(1);
  n.col(0) = rod.frame.col(2);
  for (int m = 0; m < order; ++m) {
    Eigen::Vector3d qn = Eigen::Vector3d::Zero(), qt = Eigen::Vector3d::Zero();
    for (int j = 0; j <= m && j < order; ++j) {
      const double q = -(j + 1) * a[j + 1];
      qn += q * n.col(m - j);
      qt += q * t.col(m - j);
    }
    c.col(m + 1) = h * t.col(m) / (m + 1);
    t.col(m + 1) = (qn - h * c.col(m)) / (m + 1);
    n.col(m + 1) = -qt / (m + 1);
  }
  rod.frame.setZero();
  for (int m = order; m >= 0; --m) {
    rod.frame.col(0) += c.col(m);
    rod.frame.col(1) += t.col(m);
    rod.frame.col(2) += n.col(m);
  }
  if (v != 0) rod.df = sum_derivative(a) / (h * v);
  rod.f = sum(a);
}

/// Longest step from u: in z it is short compared with the distance to the singularities of f and,
/// except at z = 0, with the distance to z = 0, where other solutions of the equation are singular.
double longest_step(double u, double v) {
  if (u == 0) return std::min(1.6, 1.0 / v);
  return std::min({1.6, 0.5 / v, 0.5 * u});
}

/// The state at u >= 0 of the rod v = const >= 0.
Rod follow(double u, double v) {
  Rod rod;
  rod.frame << 0, 1, 0, std::sin(v), 0, std::cos(v), std::cos(v), 0, -std::sin(v);
  while (rod.u < u) {
    const double end = std::min(u, rod.u + longest_step(rod.u, v));
    advance(rod, v, end - rod.u);
    rod.u = end;
  }
  return rod;
}

// tangents with a smaller angle between them (rad) count as a fold
constexpr double least_sine = 1e-6;

tl::unexpected<Error> outside_error(const char* curve, char name, double at, double half) {
  return invalid(
      "curve_{} of the translation net ends at {} = {:.7g} mm; {} = {:g} mm is past its end", curve,
      name, at < 0 ? -half : half, name, at);
}

tl::unexpected<Error> folds(double u, double v, double cosine) {
  return invalid(
      "the translation net folds (shear angle {}) near (u, v) = ({:g}, {:g}) mm, where its "
      "curves are parallel",
      cosine > 0 ? "0" : "180 degrees", u, v);
}

}  // namespace

double SphereNet::shear(double z) {
  double at = 0, f = M_PI_2, df = -1;
  // f(-z) = pi - f(z)
  while (at < std::abs(z)) {
    const double end = std::min(std::abs(z), at + (at == 0 ? 1.0 : 0.5));
    const Series a = shear_series(at, end - at, f, df);
    f = sum(a);
    df = sum_derivative(a) / (end - at);
    at = end;
  }
  return z < 0 ? M_PI - f : f;
}

Result<NetPoint> SphereNet::at(double u, double v) const {
  const double a = std::abs(u) / radius_, b = std::abs(v) / radius_;
  if (!(a * b < fold))
    return invalid(
        "the net on the sphere of radius {:g} mm folds (shear angle {}) where u v = {:.7g} "
        "mm^2; (u, v) = ({:g}, {:g}) mm is past its end",
        radius_, (u < 0) == (v < 0) ? "0" : "180 degrees",
        ((u < 0) == (v < 0) ? fold : -fold) * radius_ * radius_, u, v);
  const Rod rod = follow(a, b);
  const Eigen::Vector3d t = rod.frame.col(1), n = rod.frame.col(2);
  NetPoint point;
  point.position = radius_ * rod.frame.col(0);
  point.tangent_u = t;
  point.tangent_v = std::cos(rod.f) * t + std::sin(rod.f) * n;
  point.omega = rod.f;
  point.K = 1 / (radius_ * radius_);
  // the other quadrants are mirror images; a mirror inverts one tangent, omega becomes pi - omega
  const auto mirror = [&](int axis, Eigen::Vector3d& turned) {
    for (Eigen::Vector3d* vector : {&point.position, &point.tangent_u, &point.tangent_v})
      (*vector)[axis] = -(*vector)[axis];
    turned = -turned;
    point.omega = M_PI - point.omega;
  };
  if (u < 0) mirror(0, point.tangent_u);
  if (v < 0) mirror(1, point.tangent_v);
  return point;
}

Result<TranslationNet> TranslationNet::make(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& y) {
  auto curve_u = SplineCurve::through(x), curve_v = SplineCurve::through(y);
  if (!curve_u) return invalid("curve_u: " + curve_u.error().message);
  if (!curve_v) return invalid("curve_v: " + curve_v.error().message);
  TranslationNet net(UnitSpeedCurve(std::move(*curve_u)), UnitSpeedCurve(std::move(*curve_v)));
  TRY_DO(net.check_open());
  return net;
}

Result<void> TranslationNet::check_open() const {
  // the normal changes its sign where the tangents become parallel
  constexpr int samples = 128;
  Eigen::Matrix3Xd along_u(3, samples + 1), along_v(3, samples + 1);
  const auto parameter = [](double half, int k) { return half * (2.0 * k / samples - 1); };
  for (int k = 0; k <= samples; ++k) {
    along_u.col(k) = x_.at(parameter(half_u(), k)).first;
    along_v.col(k) = y_.at(parameter(half_v(), k)).first;
  }
  for (int i = 0; i <= samples; ++i) {
    for (int j = 0; j <= samples; ++j) {
      const Eigen::Vector3d normal = along_u.col(i).cross(along_v.col(j));
      const Eigen::Vector3d before_u = along_u.col(std::max(i - 1, 0)).cross(along_v.col(j));
      const Eigen::Vector3d before_v = along_u.col(i).cross(along_v.col(std::max(j - 1, 0)));
      if (normal.norm() > least_sine && normal.dot(before_u) > 0 && normal.dot(before_v) > 0)
        continue;
      return folds(parameter(half_u(), i), parameter(half_v(), j),
                   along_u.col(i).dot(along_v.col(j)));
    }
  }
  return {};
}

Result<NetPoint> TranslationNet::at(double u, double v) const {
  if (!(std::abs(u) <= half_u())) return outside_error("u", 'u', u, half_u());
  if (!(std::abs(v) <= half_v())) return outside_error("v", 'v', v, half_v());
  const SplineCurve::Point x = x_.at(u), y = y_.at(v);
  NetPoint point;
  point.position = x.position + y.position;
  point.tangent_u = x.first;
  point.tangent_v = y.first;
  const double sine = point.tangent_u.cross(point.tangent_v).norm();
  const double cosine = point.tangent_u.dot(point.tangent_v);
  point.omega = std::atan2(sine, cosine);
  if (!(sine > least_sine)) return folds(u, v, cosine);
  // second form (C_uu . n, 0, C_vv . n), first form of determinant sin^2 omega
  const Eigen::Vector3d normal = point.normal();
  const double bend_u = normal.dot(x.second.head<3>()), bend_v = normal.dot(y.second.head<3>());
  point.K = bend_u * bend_v / (sine * sine);
  return point;
}

}  // namespace gridshell
