#include "engine/geometry/calculus.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/core/algorithms.h"

namespace gridshell {
namespace {

constexpr int points = 16;
constexpr std::size_t most_panels = 20000;  // a limit of memory for functions that are not smooth
struct Rule {
  std::array<double, points> node, weight;
};

/// Nodes and weights on [-1, 1]: Newton iteration on the Legendre polynomial's recurrence.
Rule gauss_legendre() {
  Rule rule;
  for (int k = 0; k < points; ++k) {
    double x = std::cos(M_PI * (k + 0.75) / (points + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 8; ++iteration) {
      double before = 1, p = x;
      for (int n = 2; n <= points; ++n) {
        const double next = ((2 * n - 1) * x * p - (n - 1) * before) / n;
        before = p;
        p = next;
      }
      slope = points * (before - x * p) / (1 - x * x);
      x -= p / slope;
    }
    rule.node[k] = x;
    rule.weight[k] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace

Antiderivative::Antiderivative(std::function<double(double)> f, const std::vector<double>& breaks,
                               double origin)
    : f_(std::move(f)), ends_{breaks.front()}, values_{0} {
  double size = 0;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    size += std::abs(panel(breaks[k], breaks[k + 1]));
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    if (breaks[k] < breaks[k + 1])
      add_panel(breaks[k], breaks[k + 1], panel(breaks[k], breaks[k + 1]), 1e-16 * size);
  const double at_origin = (*this)(origin);
  for (double& value : values_) value -= at_origin;
}

double Antiderivative::panel(double a, double b) const {
  static const Rule rule = gauss_legendre();
  const double middle = (a + b) / 2, half = (b - a) / 2;
  double total = 0;
  for (int k = 0; k < points; ++k) total += rule.weight[k] * f_(middle + half * rule.node[k]);
  return half * total;
}

void Antiderivative::add_panel(double a, double b, double whole, double small) {
  const double middle = (a + b) / 2;
  const double left = panel(a, middle), right = panel(middle, b);
  // the error of the halves is less than their difference from the whole; differences below `small`
  // are lost in the total sum
  const double size = (b - a) * std::max({std::abs(f_(a)), std::abs(f_(middle)), std::abs(f_(b))});
  const bool can_halve = a < middle && middle < b && ends_.size() < most_panels;
  if (can_halve && std::abs(left + right - whole) > std::max(2e-14 * size, small)) {
    add_panel(a, middle, left, small);
    add_panel(middle, b, right, small);
    return;
  }
  for (const auto& [end, half] : {std::pair(middle, left), std::pair(b, right)}) {
    ends_.push_back(end);
    values_.push_back(values_.back() + half);
  }
}

double Antiderivative::operator()(double t) const {
  const std::size_t k = piece_at(ends_, t);
  return values_[k] + panel(ends_[k], t);
}

double Antiderivative::inverse(double value) const {
  const std::size_t k = piece_at(values_, value);
  const double low = ends_[k], high = ends_[k + 1];
  const auto miss = [&](double t) -> Eigen::Vector2d {
    return {values_[k] + panel(low, t) - value, f_(t)};
  };
  const double guess = low + (high - low) * (value - values_[k]) / (values_[k + 1] - values_[k]);
  // Newton's method squares its error: after a step of 1e-10 the next would be round-off
  return bracketed_root(miss, low, high, guess, 1e-10 * (high - low));
}

}  // namespace gridshell
