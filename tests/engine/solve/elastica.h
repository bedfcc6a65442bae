// The exact elastica, also of an extensible rod: the limit of a discrete rod.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "engine/elastic/rod_material.h"

namespace gridshell {

/// A pinned inextensible rod of length 1 and stiffness EI = 1, by its elliptic modulus m [theory of
/// the elastica].
struct PinnedElastica {
  double shortening, height, thrust, energy, curvature;  ///< the last one is the largest

  explicit PinnedElastica(double m) {
    const double K = std::comp_ellint_1(std::sqrt(m)), E = std::comp_ellint_2(std::sqrt(m));
    shortening = 2 - 2 * E / K;
    height = std::sqrt(m) / K;
    thrust = 4 * K * K;
    energy = 8 * K * (E - (1 - m) * K);
    curvature = 4 * K * std::sqrt(m);
  }
};

/// Angle, its slope and the position, at the end of a rod shot with an angle and a slope, by
/// Runge-Kutta steps: d/ds of them is (slope, turn(s, angle), (sin, cos) of the angle).
template <class Turn>
Eigen::Vector4d shot(double angle, double slope, double length, const Turn& turn) {
  constexpr int steps = 1000;
  const double h = length / steps;
  const auto rate = [&](double s, const Eigen::Vector4d& y) {
    return Eigen::Vector4d(y[1], turn(s, y[0]), std::sin(y[0]), std::cos(y[0]));
  };
  Eigen::Vector4d y(angle, slope, 0, 0);
  for (int k = 0; k < steps; ++k) {
    const double s = k * h;
    const Eigen::Vector4d a = rate(s, y), b = rate(s + h / 2, y + h / 2 * a),
                          c = rate(s + h / 2, y + h / 2 * b), d = rate(s + h, y + h * c);
    y += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return y;
}

/// Zero of a function between two positions of opposite sign.
template <class Function>
double zero_of(const Function& f, double low, double high) {
  const bool rises = f(high) > 0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0) == rises ? high : low) = middle;
  }
  return low;
}

/// The arch of a rod, which consists of equal quarters, each from a point without curvature to one
/// where the rod is level: two if the ends are pinned, four if they are clamped level.
struct Elastica {
  double height = 0;  ///< of the middle above the ends, mm
  double thrust = 0;  ///< N
};

/// One quarter under a thrust P, with k = sin(alpha/2), alpha its steepest slope: natural length,
/// span and height. With the strain -P cos(theta)/EA,
///   EI theta'^2 = 2P (cos theta - cos alpha)(1 - P (cos theta + cos alpha)/(2 EA)),
/// and sin(theta/2) = k sin(phi); over phi in (0, pi/2) the trapezoidal rule is exact to round-off.
struct ElasticaQuarter {
  double length = 0, span = 0, height = 0;

  ElasticaQuarter(double P, double k, const RodSection& rod) {
    constexpr int points = 200;
    const auto stiffer = [&](double cosines) { return std::sqrt(1 - P * cosines / (2 * rod.EA)); };
    for (int n = 0; n <= points; ++n) {
      const double half = k * std::sin(M_PI / 2 * n / points), c = 1 - 2 * half * half;
      const double by_phi =
          1 / (std::sqrt(P / rod.EI) * std::sqrt(1 - half * half) * stiffer(c + 1 - 2 * k * k));
      const double ds = M_PI / 2 / points * by_phi * (n == 0 || n == points ? 0.5 : 1);
      length += ds;
      span += ds * c * (1 - P * c / rod.EA);
    }
    // the moment P height where it runs level is EI theta'
    height = 2 * k * std::sqrt(rod.EI / P) * stiffer(2 - 2 * k * k);
  }
};

/// The arch of a rod of this length over a span, by Newton's method in (P, k).
inline Elastica elastica(double length, double span, const RodSection& rod, int quarters) {
  double P = 1.1 * std::pow(quarters * M_PI / (2 * length), 2) * rod.EI, k = 0.5;
  for (int n = 0; n < 100; ++n) {
    const double by_P = 1e-6 * P, by_k = 1e-6;
    const auto off = [&](double force, double slope) {
      const ElasticaQuarter at(force, slope, rod);
      return Eigen::Vector2d(at.length - length / quarters, at.span - span / quarters);
    };
    Eigen::Matrix2d slopes;
    slopes << (off(P + by_P, k) - off(P, k)) / by_P, (off(P, k + by_k) - off(P, k)) / by_k;
    Eigen::Vector2d change = slopes.inverse() * off(P, k);
    if (std::abs(change[1]) < 1e-13) break;
    while (k - change[1] < 0.01 || k - change[1] > 0.98 || change[0] > 0.7 * P) change /= 2;
    P -= change[0], k -= change[1];
  }
  const ElasticaQuarter found(P, k, rod);
  REQUIRE(found.length == Approx(length / quarters).epsilon(1e-12));
  REQUIRE(found.span == Approx(span / quarters).epsilon(1e-12));
  return {found.height * (quarters == 4 ? 2 : 1), P};
}

}  // namespace gridshell
