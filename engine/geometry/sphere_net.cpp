#include "engine/geometry/sphere_net.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gridshell {
namespace {

// the series about z = 0 converges for |z| < 2.95; with steps as below the rest is under 1e-17
constexpr int order = 36;
using Series = std::array<double, order + 1>;

/// Taylor coefficients of f along z = z0 + k t, t in [0, 1], from f and f' = df/dz at z0:
/// z0 (n+2)(n+1) a_{n+2} + k (n+1)^2 a_{n+1} = -k^2 s_n, s those of sin f.
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
    // at the pole the equation is of first order in the coefficients
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

/// sum of n a_n: k df/dz at the end of the step
double sum_derivative(const Series& a) {
  double total = 0;
  for (int n = order; n >= 1; --n) total += n * a[n];
  return total;
}

/// The rod v = const on the unit sphere, at u.
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

/// Longest step from u: short in z against the distance to the singularities of f and, once away
/// from z = 0 (where solutions other than ours are singular), against that too.
double longest_step(double u, double v) {
  if (u == 0) return std::min(1.6, 1.0 / v);
  return std::min({1.6, 0.5 / v, 0.5 * u});
}

/// the rod v >= 0 from u = 0 to u >= 0
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
    return fail(Fault::bad_input,
                fmt::format("the net on the sphere of radius {:g} mm folds (shear angle {}) where "
                            "u v = {:.7g} mm^2; (u, v) = ({:g}, {:g}) mm lies beyond",
                            radius_, (u < 0) == (v < 0) ? "0" : "180 degrees",
                            ((u < 0) == (v < 0) ? fold : -fold) * radius_ * radius_, u, v));
  const Rod rod = follow(a, b);
  const Eigen::Vector3d t = rod.frame.col(1), n = rod.frame.col(2);
  NetPoint point;
  point.position = radius_ * rod.frame.col(0);
  point.tangent_u = t;
  point.tangent_v = std::cos(rod.f) * t + std::sin(rod.f) * n;
  point.omega = rod.f;
  point.K = 1 / (radius_ * radius_);
  // mirror planes x = 0 and y = 0; a mirror turns one tangent and the angle
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

}  // namespace gridshell
