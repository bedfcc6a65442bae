// What every Chebyshev net must satisfy, checked without the code that made it.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/geometry/calculus.h"
#include "engine/geometry/chebyshev_net.h"
#include "engine/geometry/revolution_net.h"

namespace gridshell {

inline NetPoint point_of(const ChebyshevNet& net, double u, double v) {
  return net.at(u, v).value();
}

/// integral of f over [a, b]
inline double integral(const std::function<double(double)>& f, double a, double b) {
  return Antiderivative(f, {a, b}, a)(b);
}

/// largest of | |C_u| - 1 |, | |C_v| - 1 | and | angle between C_u and C_v - omega |
inline double unit_residual(const ChebyshevNet& net, double u, double v) {
  const NetPoint p = point_of(net, u, v);
  const double angle =
      std::atan2(p.tangent_u.cross(p.tangent_v).norm(), p.tangent_u.dot(p.tangent_v));
  return std::max({std::abs(p.tangent_u.norm() - 1), std::abs(p.tangent_v.norm() - 1),
                   std::abs(angle - p.omega)});
}

/// largest |C(u1, v) - C(u0, v) - integral of C_u du| and the same along v, mm
inline double tangent_residual(const ChebyshevNet& net, double u0, double u1, double v0,
                               double v1) {
  double worst = 0;
  const NetPoint a = point_of(net, u0, v0), b = point_of(net, u1, v0), c = point_of(net, u0, v1);
  for (int k = 0; k < 3; ++k) {
    const auto along_u = [&](double u) { return point_of(net, u, v0).tangent_u[k]; };
    const auto along_v = [&](double v) { return point_of(net, u0, v).tangent_v[k]; };
    worst = std::max(worst, std::abs(b.position[k] - a.position[k] - integral(along_u, u0, u1)));
    worst = std::max(worst, std::abs(c.position[k] - a.position[k] - integral(along_v, v0, v1)));
  }
  return worst;
}

/// d/dx at 0 by the central difference of eighth order
template <class F>
auto derivative(const F& f, double h) {
  using Value = std::decay_t<decltype(f(h))>;
  const auto step = [&](int k) -> Value { return f(k * h) - f(-k * h); };
  return Value(
      (step(1) * (4. / 5) - step(2) * (1. / 5) + step(3) * (4. / 105) - step(4) * (1. / 280)) / h);
}

/// C_uv from C_u and from C_v: their difference, and the parts along C_u and C_v that must vanish;
/// times `scale`, a length of the net
inline double mixed_residual(const ChebyshevNet& net, double u, double v, double scale) {
  using Vector = Eigen::Vector3d;
  const double h = scale / 60;
  const NetPoint p = point_of(net, u, v);
  const Vector uv =
      derivative([&](double d) -> Vector { return point_of(net, u, v + d).tangent_u; }, h);
  const Vector vu =
      derivative([&](double d) -> Vector { return point_of(net, u + d, v).tangent_v; }, h);
  return scale *
         std::max({(uv - vu).norm(), std::abs(uv.dot(p.tangent_u)), std::abs(uv.dot(p.tangent_v))});
}

/// The net whose rods cross at right angles in the middle: c = 1/(sqrt(2) r).
inline RevolutionNet right_angled(const Profile& profile) {
  return RevolutionNet::make(profile, M_SQRT1_2 / profile.at(profile.origin).r).value();
}

/// Gauss' equation omega_uv = -K sin omega, residual times scale^2
inline double gauss_residual(const ChebyshevNet& net, double u, double v, double scale) {
  const double h = scale / 60;
  const auto omega_u = [&](double dv) {
    return derivative([&](double du) { return point_of(net, u + du, v + dv).omega; }, h);
  };
  const NetPoint p = point_of(net, u, v);
  return scale * scale * std::abs(derivative(omega_u, h) + p.K * std::sin(p.omega));
}

/// Hazzidakis: the integral of K dA = K sin omega du dv over a patch against its four angles,
/// 2 pi - (w00 + (pi - w10) + w11 + (pi - w01))
inline double hazzidakis_residual(const ChebyshevNet& net, double u0, double u1, double v0,
                                  double v1) {
  const auto omega = [&](double u, double v) { return point_of(net, u, v).omega; };
  const auto strip = [&](double u) {
    return integral(
        [&](double v) {
          const NetPoint p = point_of(net, u, v);
          return p.K * std::sin(p.omega);
        },
        v0, v1);
  };
  return std::abs(integral(strip, u0, u1) + omega(u0, v0) - omega(u1, v0) + omega(u1, v1) -
                  omega(u0, v1));
}

}  // namespace gridshell
