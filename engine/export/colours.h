// Colours of K for what other programs show: blue below zero, white at it, red above.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

namespace gridshell::exports {

/// Symmetric about zero; 98 of 100 cells lie within.
struct ColourRange {
  double end = 1;  ///< rad

  /// sRGB, 0 to 1; grey where K is not known.
  std::array<double, 3> colour(double K) const;
};

ColourRange range_of(const Eigen::VectorXd& K);

/// From sRGB to linear light.
std::array<double, 3> linear(const std::array<double, 3>& srgb);

}  // namespace gridshell::exports
