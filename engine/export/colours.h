// Colours of K for what other programs show: blue below zero, white at it, red above.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

namespace gridshell::exports {

/// Symmetric about zero; 98 of 100 cells lie within.
struct ColourRange {
  double end = 1;  ///< rad

  using Colour = std::array<double, 3>;  ///< sRGB, 0 to 1
  static constexpr Colour below{0.13, 0.40, 0.67}, zero{0.97, 0.97, 0.97}, above{0.70, 0.09, 0.17},
      unknown{0.7, 0.7, 0.7};

  /// From `zero` to `below` or `above`.
  std::array<double, 3> colour(double K) const;
};

ColourRange range_of(const Eigen::VectorXd& K);

/// From sRGB to linear light.
std::array<double, 3> linear(const std::array<double, 3>& srgb);

}  // namespace gridshell::exports
