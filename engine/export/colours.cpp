#include "engine/export/colours.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gridshell::exports {

std::array<double, 3> ColourRange::colour(double K) const {
  if (!std::isfinite(K)) return unknown;
  const double share = std::min(std::abs(K) / end, 1.0);
  const Colour& full = K < 0 ? below : above;
  Colour mixed{};
  for (std::size_t k = 0; k < 3; ++k) mixed[k] = zero[k] + share * (full[k] - zero[k]);
  return mixed;
}

ColourRange range_of(const Eigen::VectorXd& K) {
  std::vector<double> sizes;
  for (const double value : K)
    if (std::isfinite(value)) sizes.push_back(std::abs(value));
  if (sizes.empty()) return {};
  std::ranges::sort(sizes);
  const double end = sizes[std::size_t(0.98 * double(sizes.size() - 1))];
  return {end > 0 ? end : 1};
}

std::array<double, 3> linear(const std::array<double, 3>& srgb) {
  std::array<double, 3> light{};
  for (std::size_t k = 0; k < 3; ++k)
    light[k] = srgb[k] <= 0.04045 ? srgb[k] / 12.92 : std::pow((srgb[k] + 0.055) / 1.055, 2.4);
  return light;
}

}  // namespace gridshell::exports
