// Automatic differentiation to second order: a value with its gradient and Hessian by N unknowns.
#pragma once

#include <Eigen/Core>
#include <cmath>

template <int N>
struct Jet {
  double v = 0;
  Eigen::Matrix<double, N, 1> g = Eigen::Matrix<double, N, 1>::Zero();
  Eigen::Matrix<double, N, N> h = Eigen::Matrix<double, N, N>::Zero();

  Jet(double value = 0) : v(value) {}
  static Jet unknown(double value, int k) {
    Jet x(value);
    x.g[k] = 1;
    return x;
  }
  /// f(this) from f, f', f'' at v
  Jet chain(double f, double f1, double f2) const {
    Jet y(f);
    y.g = f1 * g;
    y.h = f1 * h + f2 * g * g.transpose();
    return y;
  }
  friend Jet operator+(Jet a, const Jet& b) {
    a.v += b.v, a.g += b.g, a.h += b.h;
    return a;
  }
  friend Jet operator-(Jet a, const Jet& b) {
    a.v -= b.v, a.g -= b.g, a.h -= b.h;
    return a;
  }
  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet y(a.v * b.v);
    y.g = a.v * b.g + b.v * a.g;
    y.h = a.v * b.h + b.v * a.h + a.g * b.g.transpose() + b.g * a.g.transpose();
    return y;
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    return a * b.chain(1 / b.v, -1 / (b.v * b.v), 2 / (b.v * b.v * b.v));
  }
  friend Jet sqrt(const Jet& a) {
    const double r = std::sqrt(a.v);
    return a.chain(r, 0.5 / r, -0.25 / (r * a.v));
  }
  friend Jet sin(const Jet& a) { return a.chain(std::sin(a.v), std::cos(a.v), -std::sin(a.v)); }
  friend Jet cos(const Jet& a) { return a.chain(std::cos(a.v), -std::sin(a.v), -std::cos(a.v)); }
  /// angle of (x, y) by the arctangent of whichever ratio is small
  friend Jet atan2(const Jet& y, const Jet& x) {
    const double value = std::atan2(y.v, x.v);
    const bool flat = std::abs(x.v) > std::abs(y.v);
    const Jet r = flat ? y / x : x / y;
    const double d = 1 + r.v * r.v, sign = flat ? 1 : -1;
    return r.chain(value, sign / d, -sign * 2 * r.v / (d * d));
  }
};

/// Three jets as a vector.
template <class T>
struct Vec {
  T x, y, z;
  friend Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec operator*(const T& s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend T dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend Vec cross(const Vec& a, const Vec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend Vec unit(const Vec& a) { return (T(1) / sqrt(dot(a, a))) * a; }
};
